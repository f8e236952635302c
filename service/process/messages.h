#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "service/process/frames.h"

namespace gaitmill {

/// What a Frame's kind means. An item (an input part, a checkpoint, a result) is announced and its
/// bytes follow in kData messages until the next announcement.
enum class Message : std::uint8_t {
  kData,         ///< bytes of the item announced last
  kPart,         ///< to the child: part, file name
  kSettings,     ///< to the child: name
  kCheckpoint,   ///< either way: of the next finished stage
  kSubject,      ///< to the child: mass [kg], height [m]
  kGo,           ///< to the child: that was all
  kProgress,     ///< from the child: stage, fraction
  kWarning,      ///< sentence
  kItem,         ///< kind, name
  kStageDone,    ///< stage; the items since the last one are its own
  kDone,         ///< verdict, then warnings; everything is said
  kUnderstood,   ///< of an inspection: what was understood as JSON, then warnings
  kError,        ///< an Error; nothing follows
  kOutOfMemory,  ///< nothing follows
  kTask,         ///< to the child that draws: what to draw; items that follow replace earlier ones
};

/// Bytes of an item that travel in one message.
inline constexpr std::size_t kPieceSize = 1U << 20U;

Frame makeFrame(Message message, std::vector<std::string> fields = {});
Message messageOf(const Frame& frame);

/// A double bit for bit.
std::string packDouble(double value);
/// @throws Error kJobCrashed if these are not the bytes of a double
double unpackDouble(const std::string& bytes);

Frame makeErrorFrame(const Error& error);
/// The error with place and context. @throws Error kJobCrashed if the frame holds none
Error readErrorFrame(const Frame& frame);

/// The field with this number. @throws Error kJobCrashed if there is none
const std::string& fieldOf(const Frame& frame, std::size_t number);

}  // namespace gaitmill
