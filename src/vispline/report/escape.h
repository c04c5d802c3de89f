/// The one place where text becomes safe: whatever a file, a flag or a user named, it stays text.
#pragma once

#include <string>
#include <string_view>

namespace vispline::report {

/// Valid UTF-8 in which nothing hides: control, bidi and invisible characters become `\u202E`, bytes that are not UTF-8
/// become `\xFF`. Applying it twice changes nothing.
std::string visible_text(std::string_view untrusted);

/// visible_text with & < > " ' as entities: safe between tags and inside quoted attributes, in HTML and in XML.
std::string escaped(std::string_view untrusted);

/// Estimated width of a line in a sans-serif font, in units of the font size.
double text_width_em(std::string_view visible);

/// visible_text, cut with an ellipsis so that text_width_em stays at or below max_em.
std::string shortened(std::string_view untrusted, double max_em);

}  // namespace vispline::report
