#include "api/server.h"

#include <utility>

#include "api/reactor.h"

namespace gaitmill::api {

Server::Server(std::vector<Route> routes, ServerOptions options, ServerLog log)
    : reactor_(std::make_unique<Reactor>(std::move(routes), std::move(options), std::move(log))) {}

Server::~Server() = default;

int Server::bind() {
  return reactor_->bind();
}

void Server::run() {
  reactor_->run();
}

void Server::stop() {
  reactor_->stop();
}

void Server::notify(const Topic& topic) {
  reactor_->notify(topic);
}

ServerLoad Server::load() const {
  return reactor_->load();
}

}  // namespace gaitmill::api
