#include "service/figure_service.h"

#include <utility>

#include "core/base/error.h"
#include "core/figure/svg.h"
#include "core/figure/vega_lite.h"
#include "service/job_tag.h"
#include "service/stored_results.h"

namespace gaitmill {

FigureService::FigureService(Stores& stores, FigureFunctions functions)
    : stores_(stores), functions_(std::move(functions)) {}

std::string FigureService::findTag(const api::Identity& who, const std::string& job_id) {
  return makeTag({"figures", identifyResults(stores_.jobs.find(who.tenant, job_id))});
}

std::vector<FigureInfo> FigureService::list(const api::Identity& who, const std::string& job_id) {
  return functions_.list(StoredResults(stores_.jobs, who.tenant, job_id));
}

Figure FigureService::find(const api::Identity& who,
                           const std::string& job_id,
                           const std::string& name) {
  // The job first: tables read after it are at least as new.
  const api::JobView job = stores_.jobs.find(who.tenant, job_id);
  try {
    return functions_.make(StoredResults(stores_.jobs, who.tenant, job_id), name);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kFigureNotFound || api::isFinal(job.state)) {
      throw;
    }
    throw Error(ErrorCode::kResultNotReady,
                "the job is " + std::string(api::jobStateName(job.state)) + " and has no figure '" +
                    name + "' yet; figures come with the tables they show",
                {"", 0, 0, "name"});
  }
}

std::string FigureService::encode(const Figure& figure, api::FigureForm form) {
  SvgOptions options;
  options.heading = true;
  switch (form) {
    case api::FigureForm::kVegaLite:
      break;
    case api::FigureForm::kData:
      return renderFigureData(figure);
    case api::FigureForm::kSvg:
      return renderSvg(figure, options);
  }
  return renderVegaLite(figure);
}

}  // namespace gaitmill
