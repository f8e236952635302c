#include "service/port_services.h"

namespace gaitmill {

namespace {

ChildCommand makeDrawCommand(const PortOptions& options) {
  ChildCommand command = {options.draw.program, "draw", "--models", options.models};
  if (!options.draw.geometry.empty()) {
    command.insert(command.end(), {"--geometry", options.draw.geometry});
  }
  return command;
}

}  // namespace

PortServices::PortServices(Stores& stores,
                           const PipelineFunctions& functions,
                           WorkerSignals workers,
                           const PortOptions& options)
    : shipped_(options.models, functions),
      known_marker_sets_(shipped_, stores.marker_sets),
      composer_(stores, shipped_, SettingsCatalog(options.models), functions),
      estimates_([&stores] { return stores.jobs.calcStageEstimates(); }, options.workers),
      key_cache_(makeKeyLookup(stores.keys), options.keys),
      models_(stores.models, shipped_.models(), functions.read_model, options.quota),
      marker_sets_(
          stores.marker_sets, shipped_.markerSets(), functions.read_marker_set, options.quota),
      drawing_(makeDrawCommand(options), options.draw.limits),
      image_cache_(options.draw.cache_bytes),
      figures_(stores, functions.figures),
      images_(stores,
              drawing_,
              image_cache_,
              {options.draw.max_pixels, options.quota, options.draw.geometry}),
      reports_(stores, functions.figures, images_, image_cache_),
      comparisons_(stores, functions.figures),
      validations_(models_, drawing_, image_cache_),
      archive_(stores, shipped_, composer_, reports_, functions, options.spool_folder),
      trials_(stores, known_marker_sets_, functions.inspect, options.quota),
      jobs_(stores, composer_, estimates_, workers, options.quota),
      studies_(stores, composer_, workers, options.quota),
      results_(stores, archive_, functions.encode_sto),
      settings_(SettingsCatalog(options.models), functions.default_settings),
      keys_(stores.keys, &key_cache_),
      idempotency_(stores.idempotency) {}

api::Ports PortServices::ports(api::StatusPort& status) {
  return {trials_,
          jobs_,
          studies_,
          results_,
          figures_,
          images_,
          reports_,
          comparisons_,
          validations_,
          models_,
          marker_sets_,
          settings_,
          keys_,
          idempotency_,
          status};
}

}  // namespace gaitmill
