#pragma once

#include <string>

namespace gaitmill::api {

/// Appends the shortest digits that give the same double back.
void appendNumber(std::string& out, double value);

/// A cell of a CSV file. Labels come from uploaded files, so they may hold anything.
std::string quoteCsv(const std::string& text);

/// The same for words of the user's own: a cell that a spreadsheet would take for a formula ('=',
/// '+', '-', '@' in front) begins with an apostrophe.
std::string quoteUserCsv(const std::string& text);

}  // namespace gaitmill::api
