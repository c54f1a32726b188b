// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/report/write_report.h"

#include "cook/json/json.h"
#include "formats/base/atomic_file.h"
#include "pipelines/report/page.h"
#include "pipelines/report/page_data.h"
#include "pipelines/report/tables.h"

namespace hearth::report
{

Status writeReport(const std::string& json, const std::string& path, const std::string& pack,
                   const std::string& name, const ImageProgress& progress)
{
    const auto report = Json::parse(json).value_or(Json());
    if (!report.is_object() || report.value("schema", Json()) != "hearth.report/1")
        return Error{Issue::json_syntax, name, "", "is no report that hearth cook --report wrote as JSON"};
    try
    {
        if (path.ends_with(".html"))
        {
            const std::string data = pageData(json);
            const Images images =
                pack.empty() ? Images{} : renderImages(pack, importantMeshes(json), progress);
            const std::vector<LightImage> light =
                pack.empty() ? std::vector<LightImage>{} : drawLightOfPack(pack);
            return writeText(path, reportPage(data, imagesData(images, light)));
        }
        if (path.ends_with(".xml"))
            return writeText(path, junitXml(json));
        if (path.ends_with(".csv"))
            return writeText(path, assetTable(json));
    }
    catch (const JsonError& error)
    {
        // a member of another type than the schema requires
        return Error{Issue::json_syntax, name, "",
                     std::string("is no report of hearth cook: ") + error.what()};
    }
    return writeText(path, json);
}

} // namespace hearth::report
