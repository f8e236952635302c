#include "service/validation_service.h"

#include <utility>

#include "core/base/error.h"
#include "core/io/files.h"
#include "service/job_tag.h"

namespace gaitmill {

ValidationService::ValidationService(api::CatalogPort& models,
                                     DrawProcess& drawing,
                                     ByteCache& cache)
    : models_(models), drawing_(drawing), cache_(cache) {}

std::string ValidationService::findTag(const api::Identity& who,
                                       const std::string& model_id,
                                       std::uint64_t seed) {
  const api::CatalogEntry model = models_.find(who, model_id);
  return makeTag({"validation", model.sha256, std::to_string(seed)});
}

std::vector<FigureInfo> ValidationService::list(const api::Identity& who,
                                                const std::string& model_id) {
  DrawTask task;
  task.kind = DrawTask::Kind::kListValidations;
  std::vector<FigureInfo> list;
  for (Figure& figure : ask(models_.findDocument(who, model_id), task)) {
    list.push_back({std::move(figure.name), std::move(figure.title), std::move(figure.caption)});
  }
  return list;
}

Figure ValidationService::find(const api::Identity& who,
                               const std::string& model_id,
                               const std::string& name,
                               std::uint64_t seed) {
  DrawTask task;
  task.kind = DrawTask::Kind::kValidation;
  task.figure = name;
  task.seed = seed;
  std::vector<Figure> figures = ask(models_.findDocument(who, model_id), task);
  check(figures.size() == 1, "a validation is not one figure");
  return std::move(figures.front());
}

std::vector<Figure> ValidationService::ask(const api::FileContent& model, const DrawTask& task) {
  const std::string text = encodeDrawTask(task);
  const std::string key = makeTag({"validation figure", model.view.sha256, text});
  if (const ByteCache::Value kept = cache_.find(key)) {
    return decodeFigures(kept->bytes);
  }
  const DrawReply drawn = drawing_.ask({text, "model " + model.view.sha256, [&model] {
                                          DrawData data;
                                          data.model_name = model.view.name;
                                          data.picture.model_osim =
                                              api::readAll(*model.bytes, kMaximumFileSize);
                                          return encodeDrawData(data);
                                        }});
  std::vector<Figure> figures = decodeFigures(drawn.bytes);
  cache_.put(key, {drawn.content_type, drawn.bytes});
  return figures;
}

}  // namespace gaitmill
