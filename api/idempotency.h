#pragma once

#include "api/ports.h"
#include "api/route_tools.h"

namespace gaitmill::api {

/// A handler that heeds the header Idempotency-Key: the first answer to a key, an error included,
/// is the answer to every repetition (with Idempotency-Replayed: true). Answers that say "try
/// again" (429 and all from 500 on) are not kept. Throws Error kIdempotencyMismatch for another
/// request under the same key, kIdempotencyBusy while the first one is being answered.
Handler withIdempotency(IdempotencyPort& port, Handler handler);

}  // namespace gaitmill::api
