/// What a piece of work fails with, for tests.
#pragma once

#include <functional>
#include <string>

#include "vispline/core/error.h"

namespace vispline {

/// "CODE where message" of the Error that `work` throws; empty if it throws none.
inline std::string failure_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.diagnostic().code + " " + error.diagnostic().where + " " + error.diagnostic().message;
  }
  return "";
}

}  // namespace vispline
