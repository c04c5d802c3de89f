/// The look of a report page, and the policy that admits this style and nothing else.
#pragma once

#include <string>
#include <string_view>

namespace vispline::report {

/// The text of the page's only <style> element.
std::string_view page_style();

/// Content-Security-Policy: no script, no request; the style is admitted by the digest of page_style().
std::string content_security_policy();

}  // namespace vispline::report
