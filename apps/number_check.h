#pragma once

#include <CLI/CLI.hpp>

namespace visorder::apps {

// Checks of an option's text before it becomes a number, which CLI11's own let NaN and negative counts through.

/// A number from `least` to `most`.
CLI::Validator between(double least, double most);

/// A finite number above 0.
CLI::Validator positive();

/// A whole number from `least` to 2^63, without sign.
CLI::Validator count_from(unsigned least);

} // namespace visorder::apps
