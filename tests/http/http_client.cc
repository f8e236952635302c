#include "tests/http/http_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <thread>

#include <httplib.h>
#include <nlohmann/json.hpp>

namespace gaitmill {

namespace {

constexpr int kSilence = 3000;  // [ms]
// An image waits for its turn, and on a busy machine for its processor: longer than httplib would.
constexpr time_t kPatience = 60;  // [s]

ClientReply convert(const httplib::Result& result) {
  ClientReply reply;
  if (!result) {
    return reply;
  }
  reply.status = result->status;
  reply.body = result->body;
  for (const auto& [name, value] : result->headers) {
    reply.headers[name] = value;
  }
  return reply;
}

}  // namespace

nlohmann::json ClientReply::json() const {
  return nlohmann::json::parse(body);
}

ClientReply HttpClient::get(const std::string& path,
                            const std::map<std::string, std::string>& headers) const {
  httplib::Client client("127.0.0.1", port_);
  client.set_read_timeout(kPatience);
  return convert(client.Get(path, httplib::Headers(headers.begin(), headers.end())));
}

ClientReply HttpClient::post(const std::string& path,
                             const std::string& body,
                             const std::string& content_type) const {
  httplib::Client client("127.0.0.1", port_);
  return convert(client.Post(path, body, content_type));
}

ClientReply HttpClient::upload(const std::string& path,
                               const std::vector<ClientPart>& parts) const {
  httplib::MultipartFormDataItems items;
  for (const ClientPart& part : parts) {
    items.push_back({part.name, part.bytes, part.file_name, ""});
  }
  httplib::Client client("127.0.0.1", port_);
  return convert(client.Post(path, items));
}

std::string HttpClient::sendRaw(const std::string& bytes, const std::string& last) const {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port_));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::string answer;
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    std::array<char, 4096> buffer{};
    pollfd entry{socket, POLLIN, 0};
    while (::poll(&entry, 1, kSilence) > 0) {
      const ssize_t got = ::recv(socket, buffer.data(), buffer.size(), 0);
      if (got <= 0) {
        break;
      }
      answer.append(buffer.data(), static_cast<std::size_t>(got));
      if (!last.empty() && answer.find(last) != std::string::npos) {
        break;
      }
    }
  }
  ::close(socket);
  return answer;
}

nlohmann::json HttpClient::waitForState(const std::string& job_id,
                                        const std::vector<std::string>& states) const {
  const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  std::string last = "nothing";
  while (std::chrono::steady_clock::now() < until) {
    const ClientReply reply = get("/v1/jobs/" + job_id);
    if (reply.status == 200) {
      last = reply.body;
      nlohmann::json job = reply.json();
      if (std::find(states.begin(), states.end(), job["state"]) != states.end()) {
        return job;
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  throw std::runtime_error("job " + job_id + " did not get there; last seen: " + last);
}

}  // namespace gaitmill
