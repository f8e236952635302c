#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "api/ports.h"
#include "service/byte_cache.h"
#include "service/draw_process.h"
#include "service/draw_task.h"

namespace gaitmill {

/// Validation figures of models behind the API, computed by the process that draws, because models
/// come from anybody.
class ValidationService : public api::ValidationPort {
 public:
  /// @param models, drawing, cache  outlive this
  ValidationService(api::CatalogPort& models, DrawProcess& drawing, ByteCache& cache);

  std::string findTag(const api::Identity& who,
                      const std::string& model_id,
                      std::uint64_t seed) override;
  std::vector<FigureInfo> list(const api::Identity& who, const std::string& model_id) override;
  Figure find(const api::Identity& who,
              const std::string& model_id,
              const std::string& name,
              std::uint64_t seed) override;

 private:
  std::vector<Figure> ask(const api::FileContent& model, const DrawTask& task);

  api::CatalogPort& models_;
  DrawProcess& drawing_;
  ByteCache& cache_;
};

}  // namespace gaitmill
