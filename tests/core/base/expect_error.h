#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "core/base/errors.h"

namespace dwell::test {

/// Expects an InputError whose message contains every one of the words.
template <class Call>
void expect_input_error(Call call, std::initializer_list<std::string> words) {
  try {
    call();
  } catch (const InputError& error) {
    const std::string message = error.what();
    for (const std::string& word : words) {
      EXPECT_NE(message.find(word), std::string::npos) << "no '" << word << "' in: " << message;
    }
    return;
  }
  ADD_FAILURE() << "no InputError";
}

}  // namespace dwell::test
