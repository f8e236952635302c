#pragma once

#include <string>
#include <vector>

#include "api/http.h"

namespace gaitmill::api {

/// SHA-256 of texts one after the other, each preceded by its length, as 64 hex digits: of a list
/// no other list has the same.
std::string hashTexts(const std::vector<std::string>& texts);

/// SHA-256 of the bytes as 64 hex digits. Reads piece by piece.
std::string hashBytes(const ByteSource& source);

/// Holds the body against the header Content-Digest (RFC 9530) if there is one: sha-256 or sha-512.
/// @throws Error kRequestDigest if the body has another hash, or the header none of the two
void checkContentDigest(const HttpRequest& request);

/// What makes two requests the same for an Idempotency-Key: method, path, query and body; of a
/// multipart body its parts, because the boundary differs from one sending to the next.
std::string hashRequest(const HttpRequest& request);

}  // namespace gaitmill::api
