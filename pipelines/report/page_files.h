// Files of page/, which the build embeds into the library.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string_view>

namespace hearth::report::page_files
{

extern const std::string_view report_html;
extern const std::string_view report_css;
extern const std::string_view dom_js;
extern const std::string_view table_js;
extern const std::string_view treemap_js;
extern const std::string_view curves_js;
extern const std::string_view rates_js;
extern const std::string_view timeline_js;
extern const std::string_view sections_js;
extern const std::string_view report_js;

} // namespace hearth::report::page_files
