// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/report/page.h"

#include "pipelines/report/page_files.h"

#include <string_view>

namespace hearth::report
{

namespace
{

/// Escape JSON, so that it contains neither the end of a script element nor the start of a comment.
std::string inScript(std::string_view json)
{
    std::string text;
    text.reserve(json.size());
    for (const char c : json)
        if (c == '<') // in strings only
            text += "\\u003c";
        else
            text += c;
    return text;
}

} // namespace

std::string reportPage(const std::string& data, const std::string& images)
{
    std::string script = "'use strict';\n";
    for (const std::string_view file :
         {page_files::dom_js, page_files::table_js, page_files::treemap_js, page_files::curves_js,
          page_files::rates_js, page_files::timeline_js, page_files::sections_js, page_files::report_js})
        script += file;
    std::string page(page_files::report_html);
    const auto put = [&](std::string_view mark, const std::string& text)
    { page.replace(page.find(mark), mark.size(), text); };
    // in reverse order, so that placeholders in the inserted data are not replaced
    put("@SCRIPT@", script);
    put("@IMAGES@", inScript(images));
    put("@DATA@", inScript(data));
    put("@STYLE@", std::string(page_files::report_css));
    return page;
}

} // namespace hearth::report
