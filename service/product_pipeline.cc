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

PipelineFunctions makeProductPipeline() {
  return {runPipeline, checkSettings, inspectTrial, encodeSto};
}

}  // namespace gaitmill
