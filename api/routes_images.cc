// Images of a job, its verdict and its report.

#include <utility>

#include "api/digest.h"
#include "api/dto/image.h"
#include "api/route_tools.h"
#include "api/routes.h"

namespace gaitmill::api {

namespace {

const std::string& jobId(const HttpRequest& request) {
  return idOf(request, "job_", ErrorCode::kJobNotFound);
}

ImageRequest readImageRequest(ImageKind kind, const HttpRequest& request) {
  return parseImageRequest(kind, [&request](const std::string& name) {
    const auto found = request.query.find(name);
    return found == request.query.end() ? std::nullopt : std::optional<std::string>(found->second);
  });
}

HttpReply paint(ImagePort& images, const HttpRequest& request, ImageKind kind) {
  const ImageRequest wanted = readImageRequest(kind, request);
  const std::string tag = images.findTag(request.identity, jobId(request), wanted);
  return replyUnlessKnown(request, "\"" + tag + "\"", [&] {
    ImageFile image = images.paint(request.identity, jobId(request), wanted);
    HttpReply reply;
    reply.content_type = std::move(image.content_type);
    reply.source = std::move(image.bytes);
    return reply;
  });
}

HttpReply findQuality(ReportPort& reports, HttpRequest& request) {
  return replyTagged(reports.findQuality(request.identity, jobId(request)));
}

// A page of our own in its own right: nothing may run in it, and nothing be loaded.
HttpReply findReport(ReportPort& reports, HttpRequest& request) {
  const std::string tag = "\"" + reports.findTag(request.identity, jobId(request)) + "-report\"";
  return replyUnlessKnown(request, tag, [&] {
    HttpReply reply;
    reply.content_type = "text/html; charset=utf-8";
    reply.headers["Content-Security-Policy"] =
        "default-src 'none'; img-src data:; style-src 'unsafe-inline'; sandbox";
    reply.body = reports.render(request.identity, jobId(request));
    return reply;
  });
}

}  // namespace

Routes makeImageRoutes(const Ports& ports) {
  const std::string job = "/v1/jobs/{id}";
  const auto painted = [&ports, &job](const std::string& name, ImageKind kind) {
    const Handler handle =
        withQuery(imageParameters(kind), [&images = ports.images, kind](HttpRequest& request) {
          return paint(images, request, kind);
        });
    return Route{"GET", job + "/images/" + name, BodyKind::kNone, handle, Scope::kRead, 0, true};
  };
  ReportPort& reports = ports.reports;
  return {
      painted("pose.png", ImageKind::kPose),
      painted("strip.png", ImageKind::kStrip),
      painted("animation.webp", ImageKind::kAnimation),
      {"GET", job + "/quality", BodyKind::kNone, on(reports, findQuality), Scope::kRead},
      {"GET",
       job + "/report.html",
       BodyKind::kNone,
       on(reports, findReport),
       Scope::kRead,
       0,
       true},
  };
}

}  // namespace gaitmill::api
