#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace gaitmill::load {

using Clock = std::chrono::steady_clock;

/// What a run of requests gave.
struct Figures {
  std::vector<double> latencies_ms;  ///< of answers with a status below 400
  std::uint64_t refused = 0;         ///< answers with another status
  std::uint64_t failed = 0;          ///< connections that broke
  int first_refusal = 0;             ///< status
  double seconds = 0;

  /// The latency that this share of the answers, 0 to 1, does not exceed [ms].
  double findQuantile(double share);
  std::string describe(const std::string& name);
};

struct RingOptions {
  int port = 0;
  int connections = 32;
  double seconds = 10;
  double rate = 0;  ///< [requests/s]; 0 = the next as soon as one is answered
};

/// Keeps requests under way on several connections, from one thread. With a rate, requests have
/// their moments, and a latency counts from there, even if no connection was free to send it.
/// @param make_request  the bytes of the request with this number
Figures runRing(const RingOptions& options,
                const std::function<std::string(std::uint64_t)>& make_request);

/// A blocking connection to the service on this machine. @returns the socket
int connectTo(int port);

}  // namespace gaitmill::load
