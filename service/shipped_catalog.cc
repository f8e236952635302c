#include "service/shipped_catalog.h"

#include <algorithm>
#include <filesystem>

#include "core/io/files.h"
#include "service/storage/sha256.h"

namespace gaitmill {

namespace {

namespace fs = std::filesystem;

ShippedDocument readDocument(const fs::path& path, const DocumentReader& read) {
  ShippedDocument document;
  document.file = {path.filename().string(), readFile(path.string())};
  document.entry.id = path.stem().string();
  document.entry.name = document.entry.id;
  document.entry.shipped = true;
  document.entry.size = static_cast<std::int64_t>(document.file.bytes.size());
  document.entry.sha256 = calcSha256(document.file.bytes);
  document.entry.summary_json = read(document.file);
  return document;
}

std::vector<fs::path> listModels(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator(folder, absent)) {
    const fs::path path = entry.path() / (entry.path().filename().string() + ".osim");
    if (fs::is_regular_file(path, absent)) {
      paths.push_back(path);
    }
  }
  return paths;
}

std::vector<fs::path> listMarkerSets(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator(folder / "marker_sets", absent)) {
    if (entry.path().extension() == ".json") {
      paths.push_back(entry.path());
    }
  }
  return paths;
}

std::vector<ShippedDocument> readDocuments(std::vector<fs::path> paths,
                                           const DocumentReader& read) {
  std::sort(paths.begin(), paths.end());
  std::vector<ShippedDocument> documents;
  for (const fs::path& path : paths) {
    documents.push_back(readDocument(path, read));
  }
  return documents;
}

const ShippedDocument* findByName(const std::vector<ShippedDocument>& documents,
                                  const std::string& name) {
  const auto found = std::find_if(documents.begin(), documents.end(), [&](const auto& document) {
    return document.entry.id == name;
  });
  return found == documents.end() ? nullptr : &*found;
}

}  // namespace

ShippedCatalog::ShippedCatalog(const std::string& models_folder, const PipelineFunctions& functions)
    : models_(readDocuments(listModels(models_folder), functions.read_model)),
      marker_sets_(readDocuments(listMarkerSets(models_folder), functions.read_marker_set)) {}

const ShippedDocument* ShippedCatalog::findModel(const std::string& name) const {
  return findByName(models_, name);
}

const ShippedDocument* ShippedCatalog::findMarkerSet(const std::string& name) const {
  return findByName(marker_sets_, name);
}

}  // namespace gaitmill
