#pragma once

#include <map>
#include <string>
#include <vector>

namespace gaitmill::api {

/// One part of a multipart body. `file_name` is what the client called its file, only a label:
/// never a path on our side.
struct BodyPart {
  std::string name;
  std::string file_name;
  std::string bytes;
};

/// A request as the routes see it, free of the transport. The path is decoded.
struct HttpRequest {
  std::string method;  ///< "GET", "POST"; HEAD arrives as "GET"
  std::string path;
  std::map<std::string, std::string> captures;  ///< {"id", "job_…"} for the pattern /v1/jobs/{id}
  std::map<std::string, std::string> query;     ///< first value of each parameter
  std::string accept;                           ///< header as sent, empty if absent
  std::string body;                             ///< of a JSON request
  std::vector<BodyPart> parts;                  ///< of a multipart request
};

struct HttpReply {
  int status = 200;
  std::string content_type = "application/json";
  std::map<std::string, std::string> headers;
  std::string body;
};

}  // namespace gaitmill::api
