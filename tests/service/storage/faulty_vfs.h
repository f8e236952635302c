#pragma once

namespace gaitmill {

enum class DiskFault { kInputOutput, kFull };
enum class FaultLasts { kOnce, kUntilHealed };

/// SQLite's usual file layer, with one that fails on demand in front: the n-th write, sync,
/// truncation or opening from now on fails. A failing write leaves half of its bytes. Syncs that
/// do not fail do nothing. One for the whole process, safe from any thread.
class FaultyVfs {
 public:
  /// Registers it with SQLite at the first use. @returns the name to open databases with
  static const char* name();
  static void failAt(int operation, DiskFault fault, FaultLasts lasts);
  static void heal();
  /// Counted since the last failAt() or heal().
  static int countOperations();
};

}  // namespace gaitmill
