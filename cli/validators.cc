#include "validators.h"

#include "vispline/core/error.h"
#include "vispline/results/table.h"

namespace vispline::cli {
namespace {

std::string range_text(double least, double most) { return number_text(least, 8) + " to " + number_text(most, 8); }

template <class Accepts>
CLI::Validator number(const std::string& description, const std::string& expected, Accepts accepts) {
  const auto check = [=](const std::string& input) {
    double value = 0.0;
    if (CLI::detail::lexical_cast(input, value) && accepts(value)) return std::string();
    return vispline::quoted(input) + " is not a number " + expected;
  };
  return CLI::Validator(check, description);
}

}  // namespace

CLI::Validator positive(double most) {
  return number("POSITIVE", "above 0 and up to " + number_text(most, 8),
                [=](double value) { return value > 0.0 && value <= most; });
}

CLI::Validator not_negative(double most) {
  return number("NONNEGATIVE", "from " + range_text(0.0, most),
                [=](double value) { return value >= 0.0 && value <= most; });
}

CLI::Validator between(double least, double most) {
  return number(range_text(least, most), "from " + range_text(least, most),
                [=](double value) { return value >= least && value <= most; });
}

CLI::Validator not_empty() {
  return CLI::Validator([](const std::string& input) { return std::string(input.empty() ? "the name is empty" : ""); },
                        "");
}

}  // namespace vispline::cli
