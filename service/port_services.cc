#include "service/port_services.h"

namespace gaitmill {

PortServices::PortServices(Stores& stores,
                           const PipelineFunctions& functions,
                           WorkerSignals workers,
                           const PortOptions& options)
    : shipped_(options.models, functions),
      known_marker_sets_(shipped_, stores.marker_sets),
      composer_(stores, shipped_, SettingsCatalog(options.models), functions),
      estimates_([&stores] { return stores.jobs.calcStageEstimates(); }, options.workers),
      key_cache_(makeKeyLookup(stores.keys), options.keys),
      archive_(stores, shipped_, composer_, functions.encode_sto, options.spool_folder),
      trials_(stores, known_marker_sets_, functions.inspect, options.quota),
      jobs_(stores, composer_, estimates_, workers, options.quota),
      studies_(stores, composer_, workers, options.quota),
      results_(stores, archive_, functions.encode_sto),
      models_(stores.models, shipped_.models(), functions.read_model, options.quota),
      marker_sets_(
          stores.marker_sets, shipped_.markerSets(), functions.read_marker_set, options.quota),
      settings_(SettingsCatalog(options.models), functions.default_settings),
      keys_(stores.keys, &key_cache_),
      idempotency_(stores.idempotency) {}

api::Ports PortServices::ports(api::StatusPort& status) {
  return {trials_,
          jobs_,
          studies_,
          results_,
          models_,
          marker_sets_,
          settings_,
          keys_,
          idempotency_,
          status};
}

}  // namespace gaitmill
