#pragma once

#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"

/// The statement throws an Error of this code whose message holds the text.
#define GAITMILL_EXPECT_ERROR(statement, expected, text)                      \
  try {                                                                       \
    statement;                                                                \
    ADD_FAILURE() << "nothing was thrown";                                    \
  } catch (const ::gaitmill::Error& error) {                                  \
    EXPECT_EQ(::gaitmill::codeName(error.code()),                             \
              ::gaitmill::codeName(::gaitmill::ErrorCode::expected))          \
        << error.what();                                                      \
    EXPECT_NE(error.message().find(text), std::string::npos) << error.what(); \
  }                                                                           \
  static_assert(true, "takes a semicolon")
