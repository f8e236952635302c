#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "api/http.h"

namespace gaitmill::api {

struct MultipartLimits {
  std::size_t parts = 16;
  std::size_t part_header_bytes = 4096;  ///< [bytes] of one part's headers
};

/// The boundary parameter of a multipart/form-data Content-Type, 1 to 70 of the characters that
/// RFC 2046 allows. @throws Error kRequestMalformed
std::string findMultipartBoundary(const std::string& content_type);

/// The parts of a multipart/form-data body (RFC 7578) in order, each a slice of `body`: the body is
/// read in windows and never held. It must begin with its boundary and have the final one; what
/// follows that is ignored. Any bytes are safe. Takes one pass over the body.
/// @throws Error kRequestMalformed for a body that is not multipart with this boundary, for a part
///         without name, too many parts or too long part headers; what `body` throws
std::vector<BodyPart> scanMultipart(const std::shared_ptr<const ByteSource>& body,
                                    const std::string& boundary,
                                    const MultipartLimits& limits);

}  // namespace gaitmill::api
