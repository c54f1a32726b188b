// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/picture/page.h"

#include "pipelines/report/base64.h"
#include "tests/picture/programs.h"

#include <cstdio>

namespace hearth::picture
{

namespace
{

constexpr std::string_view kHead =
    "<!doctype html><meta charset=\"utf-8\"><title>Pictures of Hearth beside path tracers</title>\n"
    "<style>body{font:14px sans-serif;background:#202020;color:#ddd;margin:1em}figure{display:inline-block;"
    "margin:0 .5em .5em 0}img{display:block;width:480px}figcaption{padding:.2em "
    "0}pre{font-size:13px}</style>\n"
    "<h1>Pictures of Hearth beside path tracers</h1>\n"
    "<p>Heat maps show FLIP: black where a viewer who flips between both pictures sees no difference.</p>\n";

std::string formatFlip(double flip)
{
    char text[32];
    std::snprintf(text, sizeof(text), "%.4f", flip);
    return text;
}

class Page
{
public:
    explicit Page(const std::string& folder) : file_(folder + "/page-image.png"), text_(kHead) {}

    void addText(std::string_view text) { text_ += text; }

    Status addImage(const reference::Image& image, const std::string& caption)
    {
        HEARTH_TRY(reference::writePng(file_, image));
        text_ += "<figure><img alt=\"\" src=\"data:image/png;base64," + report::base64(readBytes(file_)) +
                 "\"><figcaption>" + caption + "</figcaption></figure>\n";
        return success();
    }

    Status addComparison(const Comparison& c)
    {
        const std::string& name = c.reference;
        text_ += "<h3>" + name + "</h3>\n";
        HEARTH_TRY(addImage(c.open, name + ", nothing occludes"));
        HEARTH_TRY(addImage(c.full, name + ", full light; its halves differ by " + formatFlip(c.noise)));
        text_ += "<br>\n";
        HEARTH_TRY(addImage(c.open_open.heat, "nothing occludes, both: " + formatFlip(c.open_open.flip)));
        HEARTH_TRY(
            addImage(c.plain_full.heat, "default beside full light: " + formatFlip(c.plain_full.flip)));
        return addImage(c.full_full.heat, "all on beside full light: " + formatFlip(c.full_full.flip));
    }

    std::string take() { return std::move(text_); }

private:
    std::string file_;
    std::string text_;
};

} // namespace

Result<std::string> makePage(const std::vector<SceneResult>& results,
                             const std::vector<NightComparison>& nights, const std::string& folder)
{
    Page page(folder);
    page.addText("<pre>");
    page.addText(tableHead());
    for (const SceneResult& result : results)
        page.addText(describe(result));
    page.addText(describe(nights));
    page.addText("</pre>\n");
    for (const SceneResult& result : results)
    {
        page.addText("<h2>" + result.name + "</h2>\n");
        for (const Setting setting : kSettings)
        {
            HEARTH_TRY(page.addImage(result.drawn[static_cast<size_t>(setting)],
                                     "Hearth, " + std::string(settingName(setting))));
        }
        HEARTH_TRY(page.addImage(result.drawn_occlusion, "baked ambient occlusion"));
        HEARTH_TRY(page.addImage(result.occlusion.traced, "by rays"));
        for (const Comparison& comparison : result.comparisons)
            HEARTH_TRY(page.addComparison(comparison));
    }
    for (const NightComparison& night : nights)
    {
        page.addText("<h2>" + std::string(kNightScene) + ", " + night.name + "</h2>\n");
        HEARTH_TRY(page.addImage(night.drawn, "Hearth"));
        HEARTH_TRY(page.addImage(night.traced, "by rays"));
        HEARTH_TRY(page.addImage(night.difference.heat, "difference: " + formatFlip(night.difference.flip)));
    }
    return page.take();
}

} // namespace hearth::picture
