#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "api/dto/page.h"
#include "api/dto/result.h"
#include "api/http.h"
#include "core/base/error.h"

namespace gaitmill::api {

using Handler = std::function<HttpReply(HttpRequest&)>;
using Names = std::vector<std::string>;

/// A handler that refuses query parameters that the route does not know, with the nearest name.
Handler withQuery(Names known, Handler handler);

/// The route function `handle(port, request)` behind its query parameters.
template <class Port>
Handler on(Port& port, HttpReply (*handle)(Port&, HttpRequest&), Names known_query = {}) {
  return withQuery(std::move(known_query),
                   [&port, handle](HttpRequest& request) { return handle(port, request); });
}

/// Value of a query parameter, empty if absent.
std::string queryOf(const HttpRequest& request, const std::string& name);

/// The whole body as text; the transport has bounded its length.
std::string bodyText(const HttpRequest& request);

/// The capture "id" if it has the form of an id with this prefix.
/// @throws Error of this code otherwise: what cannot be an id is an id that nobody has
const std::string& idOf(const HttpRequest& request, const char* prefix, ErrorCode not_found);

/// Whether the text is the prefix and 26 letters or digits.
bool isId(const std::string& text, const std::string& prefix);

HttpReply replyJson(int status, std::string json);
/// With Location.
HttpReply replyCreated(int status, const std::string& location, std::string json);
/// 200 with a strong ETag made from the content.
HttpReply replyTagged(std::string json);
/// What a client already has, as the only tag of its If-None-Match, is not made again: 304.
/// @param tag   with its quotes
/// @param make  the reply without its ETag
HttpReply replyUnlessKnown(const HttpRequest& request,
                           const std::string& tag,
                           const std::function<HttpReply()>& make);
/// 204
HttpReply replyNothing();
/// 200 with the bytes as a download; the ETag is their hash.
HttpReply replyFile(FileContent file, const std::string& content_type);

/// What a file is called by its sender, without folders and control characters; `fallback` if that
/// leaves nothing. "C:\lab\walk1.trc" and "../../walk1.trc" are "walk1.trc": a label, never a path.
std::string makeLabel(const std::string& name, const std::string& fallback);

/// What the sender of a raw body calls it: the parameter `name`, else the file name of the header
/// Content-Disposition; empty if there is neither.
std::string findSentName(const HttpRequest& request);

/// The parameters `limit` and `cursor`. @throws Error kRequestField
/// @param prefix  of the ids that the list has; empty where names can be ids
PageRequest readPage(const HttpRequest& request, const std::string& prefix);

/// The parameters that narrow a list. @throws Error kRequestField
ListFilter readFilter(const HttpRequest& request);

/// 200 with a page of a list.
template <class View>
HttpReply replyPage(const Page<View>& page, std::string (*render)(const View&)) {
  std::vector<std::string> items;
  items.reserve(page.items.size());
  for (const View& view : page.items) {
    items.push_back(render(view));
  }
  return replyTagged(renderPage(items, page.next_cursor));
}

}  // namespace gaitmill::api
