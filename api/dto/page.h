#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gaitmill::api {

/// Which part of a list: newest first, after the entry that the cursor names.
struct PageRequest {
  std::string cursor;  ///< id of the last entry of the page before, empty for the first page
  int limit = 50;      ///< 1 to 200
};

template <class View>
struct Page {
  std::vector<View> items;
  std::string next_cursor;  ///< empty on the last page
};

/// What a list may be narrowed to; empty members ask nothing. Not every resource has every member.
struct ListFilter {
  std::string state;                           ///< of jobs
  std::string subject;                         ///< of trials, and of the trials of jobs
  std::string label;                           ///<
  std::string trial_id;                        ///< of jobs
  std::string study_id;                        ///< of jobs
  std::optional<std::int64_t> created_after;   ///< [ms since 1970 UTC], exclusive
  std::optional<std::int64_t> created_before;  ///< [ms since 1970 UTC], exclusive
};

/// {"items": […], "next_cursor": … or null}, the shape of every list.
/// @param items  JSON values
std::string renderPage(const std::vector<std::string>& items, const std::string& next_cursor);

}  // namespace gaitmill::api
