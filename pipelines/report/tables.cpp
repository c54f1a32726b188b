// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/report/tables.h"

#include "cook/json/json.h"

#include <fmt/format.h>
#include <string_view>

namespace hearth::report
{

namespace
{

std::string escapedXml(std::string_view text)
{
    std::string escaped;
    for (const char c : text)
        switch (c)
        {
        case '&':
            escaped += "&amp;";
            break;
        case '<':
            escaped += "&lt;";
            break;
        case '>':
            escaped += "&gt;";
            break;
        case '"':
            escaped += "&quot;";
            break;
        default:
            // XML 1.0 cannot represent control characters
            escaped += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    return escaped;
}

/// Quote a field of CSV; a text that a spreadsheet would take for a formula is marked as text.
std::string field(std::string text)
{
    if (!text.empty() && std::string_view("=+-@").find(text.front()) != std::string_view::npos)
        text.insert(0, "'");
    if (text.find_first_of(",\"\r\n") == std::string::npos)
        return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string formatMessage(const Json& message)
{
    const auto pointer = message.value("pointer", "");
    return fmt::format("{}{}{} [{}]", pointer, pointer.empty() ? "" : ": ", message.value("text", ""),
                       message.value("code", ""));
}

/// Return the errors of one subject, as the content of its test case.
std::string failuresXml(const Json& failures, const std::string& subject)
{
    std::string xml;
    for (const Json& failure : failures)
        if (failure.at("subject") == subject)
            xml += fmt::format("    <failure type=\"{}\" message=\"{}\">{}</failure>\n",
                               escapedXml(failure.value("code", "")), escapedXml(formatMessage(failure)),
                               escapedXml(failure.value("hint", "")));
    return xml;
}

std::string caseXml(const std::string& name, double seconds, const std::string& content)
{
    const std::string head = fmt::format("  <testcase classname=\"hearth.cook\" name=\"{}\" time=\"{:.3f}\"",
                                         escapedXml(name), seconds);
    return content.empty() ? head + "/>\n" : head + ">\n" + content + "  </testcase>\n";
}

} // namespace

std::string junitXml(const std::string& report_text)
{
    const Json report = Json::parse(report_text).value();
    const Json& failures = report.at("failures");
    std::string cases;
    size_t count = 0;
    size_t skipped = 0;
    size_t failed = 0;
    for (const Json& asset : report.at("assets"))
    {
        const auto source = asset.at("source").get<std::string>();
        std::string content = failuresXml(failures, source);
        failed += content.empty() ? size_t{0} : size_t{1};
        if (content.empty() && asset.at("state") == "not cooked")
        {
            content = "    <skipped/>\n";
            ++skipped;
        }
        cases += caseXml(source, asset.value("seconds", 0.0), content);
        ++count;
    }
    const auto output = report.at("output").get<std::string>();
    std::string content = failuresXml(failures, output);
    if (content.empty() && report.at("exit") != 0)
        content =
            fmt::format("    <failure type=\"dependency\" message=\"{}: a source could not be cooked\"/>\n",
                        report.at("status") == "incomplete" ? "not complete" : "not made");
    failed += content.empty() ? size_t{0} : size_t{1};
    cases += caseXml(output, report.at("totals").value("wall_s", 0.0), content);
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<testsuite name=\"hearth cook\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" time=\"{:.3f}\">\n"
        "{}</testsuite>\n",
        count + 1, failed, skipped, report.at("totals").value("wall_s", 0.0), cases);
}

std::string assetTable(const std::string& report_text)
{
    const Json report = Json::parse(report_text).value();
    std::string text =
        "source,state,seconds,cpu_seconds,peak_rss_bytes,bytes_in,geometry_bytes,texture_bytes,"
        "triangles,meshes,textures,warnings,dropped,error\r\n";
    for (const Json& asset : report.at("assets"))
    {
        const Json sizes = asset.value("sizes", Json::object());
        const Json clusters = asset.value("clusters", Json::object());
        size_t warnings = 0;
        std::string error;
        for (const Json& message : asset.value("messages", Json::array()))
        {
            warnings += message.value("severity", "") == "warning" ? size_t{1} : size_t{0};
            if (error.empty() && message.value("severity", "") == "error")
                error = formatMessage(message);
        }
        text += fmt::format(
            "{},{},{:.3f},{:.3f},{},{},{},{},{},{},{},{},{},{}\r\n",
            field(asset.at("source").get<std::string>()), asset.at("state").get<std::string>(),
            asset.value("seconds", 0.0), asset.value("cpu_seconds", 0.0),
            asset.value("peak_rss_bytes", uint64_t{0}), asset.value("bytes_in", uint64_t{0}),
            sizes.value("geometry", uint64_t{0}), sizes.value("textures", uint64_t{0}),
            clusters.value("totals", Json::object()).value("triangles", uint64_t{0}),
            clusters.value("meshes", Json::array()).size(), asset.value("textures", Json::array()).size(),
            warnings, asset.value("dropped", Json::array()).size(), field(error));
    }
    return text;
}

} // namespace hearth::report
