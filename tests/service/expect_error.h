#pragma once

#include <gtest/gtest.h>

#include "core/base/error.h"

/// The statement throws an Error of this code.
#define EXPECT_ERROR(statement, expected)                                                          \
  try {                                                                                            \
    statement;                                                                                     \
    ADD_FAILURE() << "nothing was thrown";                                                         \
  } catch (const ::gaitmill::Error& error) {                                                       \
    EXPECT_EQ(::gaitmill::codeName(error.code()), ::gaitmill::codeName(expected)) << error.what(); \
  }                                                                                                \
  static_assert(true, "takes a semicolon")
