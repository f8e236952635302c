#include "service/product_pipeline.h"

#include "core/io/table_writer.h"
#include "service/inspection.h"

namespace gaitmill {

namespace {

std::string encodeSto(const TimeSeries& table, api::AngleUnit angles) {
  TableWriteOptions options;
  options.angles = angles == api::AngleUnit::kDegrees ? AngleUnit::kDegrees : AngleUnit::kRadians;
  return writeTable(table, options);
}

}  // namespace

PipelineFunctions makeProductPipeline(const std::string& models_folder) {
  const Pipeline pipeline(models_folder);
  PipelineFunctions functions;
  functions.run =
      [pipeline](const TrialInput& input, const InputFile& settings, const PipelineEvents& events) {
        return pipeline.run(input, settings, events);
      };
  functions.check_settings = [pipeline](const InputFile& settings) {
    pipeline.checkSettings(settings);
  };
  functions.inspect = inspectTrial;
  functions.encode_sto = encodeSto;
  return functions;
}

}  // namespace gaitmill
