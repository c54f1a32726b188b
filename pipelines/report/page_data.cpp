// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/report/page_data.h"

#include "cook/json/json.h"
#include "formats/base/issues.h"
#include "pipelines/cookers/registry.h"
#include "pipelines/report/base64.h"

#include <algorithm>
#include <set>

namespace hearth::report
{

namespace
{

// Maximum of listed dependencies of an asset; the page shows only the number of the others.
constexpr size_t kMaxDependencies = 100;

Json getElements(const Json& object, const char* key)
{
    const Json* list = object.find(key);
    return list != nullptr && list->is_array() ? *list : Json::array();
}

/// Return a row: stage, state, seconds, bytes, start or null, lane, cpu seconds, peak, causes
Json stageRow(const Json& stage)
{
    return Json::array({stage.at("stage"), stage.value("state", ""), stage.value("seconds", 0.0),
                        stage.value("bytes", uint64_t{0}), stage.value("start_s", Json()),
                        stage.value("lane", 0), stage.value("cpu_seconds", 0.0),
                        stage.value("peak_rss_bytes", uint64_t{0}), stage.value("why", Json::array())});
}

/// Return a row: clusters, triangles, largest and mean error, then the largest of positions, normals
/// and UVs
Json levelRow(const Json& level)
{
    const auto largest = [&](const char* key) { return level.value(key, Json::object()).value("max", 0.0); };
    return Json::array({level.at("clusters"), level.at("triangles"), level.value("max_error", 0.0),
                        level.value("mean_error", 0.0), largest("position_error"), largest("normal_error"),
                        largest("uv_error")});
}

/// Return a row: name, asset, triangles, vertices, bytes, clusters, pages, levels
Json meshRow(const Json& mesh, size_t asset)
{
    const Json source = mesh.value("source", Json::object());
    Json levels = Json::array();
    for (const Json& level : getElements(mesh, "levels"))
        levels.push_back(levelRow(level));
    return Json::array({mesh.value("name", ""), asset, source.value("triangles", uint64_t{0}),
                        source.value("vertices", uint64_t{0}),
                        mesh.value("bytes", Json::object()).value("pages_stored", uint64_t{0}),
                        mesh.value("clusters", 0), mesh.value("pages", 0), levels});
}

/// Return a row: name, asset, origin, triangles, whether it is closed, the larger distance, bytes
Json proxyRow(const Json& proxy, size_t asset)
{
    const double distance = std::max(proxy.value("distance", 0.0), proxy.value("mesh_distance", 0.0));
    return Json::array({proxy.value("name", ""), asset, proxy.value("origin", ""),
                        proxy.value("triangles", uint64_t{0}), proxy.value("closed", false), distance,
                        proxy.value("bytes", uint64_t{0})});
}

Json getPsnr(const Json& texture, const char* key)
{
    const Json error = texture.value(key, Json());
    return error.is_object() ? error.value("psnr_db", Json()) : Json();
}

/// Return material and role of each use.
Json usesRow(const Json& texture)
{
    Json uses = Json::array();
    for (const Json& use : getElements(texture, "uses"))
        uses.push_back(Json::array({use.value("material", ""), use.value("role", "")}));
    return uses;
}

/// Return an error of an encoding in the unit of its role; null: exact, or there is no target.
Json convertedError(const Json& encoding, const char* key)
{
    const Json error = encoding.value(key, Json());
    for (const char* unit : {"psnr_db", "degrees", "stops"})
        if (error.is_object() && error.contains(unit))
            return error[unit];
    return {};
}

/// Return what the encoding of a texture has lost, and what the search looked at: role, error, error of
/// 99.9 % of the texels, of smooth areas, their targets, whether they are held, reason of the format,
/// place of the pictures, error of their brightest colour, and candidates (format, bytes, error, of
/// smooth areas). Null where nothing was encoded.
Json encodingRow(const Json& texture)
{
    const Json encoding = texture.value("encoding", Json());
    if (!encoding.is_object())
        return {};
    const Json picture = encoding.value("picture", Json::object());
    Json place = Json::array();
    for (const char* key : {"x", "y", "error_x", "width", "height"})
        if (picture.contains(key))
            place.push_back(picture[key]);
    Json candidates = Json::array();
    for (const Json& candidate : getElements(encoding, "estimates"))
        candidates.push_back(
            Json::array({candidate.at("format"), candidate.at("bytes"), convertedError(candidate, "error"),
                         convertedError(candidate, "error_smooth")}));
    return Json::array({encoding.value("role", ""), convertedError(encoding, "error"),
                        convertedError(encoding, "error_p999"), convertedError(encoding, "error_smooth"),
                        convertedError(encoding, "target"), convertedError(encoding, "target_smooth"),
                        encoding.value("holds_target", true), encoding.value("reason", ""), place,
                        convertedError(picture, "brightest"), candidates});
}

/// Return a row: name, asset, width, height, mips, format, content, bytes in the file, bytes in memory,
/// PSNR of half the size, whether that was measured, whether it is a placeholder, encoding, uses
Json textureRow(const Json& texture, size_t asset)
{
    return Json::array({texture.value("name", ""), asset, texture.value("width", 0),
                        texture.value("height", 0), texture.value("mips", 0), texture.value("format", ""),
                        texture.value("content", ""), texture.value("bytes_stored", uint64_t{0}),
                        texture.value("bytes", uint64_t{0}), getPsnr(texture, "half_size_error"),
                        texture.contains("half_size_error"), texture.value("placeholder", false),
                        encodingRow(texture), usesRow(texture)});
}

Json makeAsset(const Json& asset)
{
    Json slim;
    for (const char* key : {"source", "state", "seconds", "cpu_seconds", "peak_rss_bytes", "bytes_in", "key",
                            "sha256", "why", "sizes", "messages", "dropped", "texture_pictures"})
        if (asset.contains(key))
            slim[key] = asset[key];
    slim["stages"] = Json::array();
    for (const Json& stage : getElements(asset, "stages"))
        slim["stages"].push_back(stageRow(stage));
    const Json dependencies = getElements(asset, "deps");
    slim["dep_count"] = dependencies.size();
    slim["deps"] = Json::array();
    for (size_t i = 0; i < std::min(dependencies.size(), kMaxDependencies); ++i)
        slim["deps"].push_back(dependencies[i]);
    return slim;
}

std::string formatCode(const IssueInfo& info)
{
    return (info.kind == IssueClass::warning ? "W" : "E") + std::to_string(static_cast<unsigned>(info.issue));
}

/// Return the explanations of `hearth explain` for all codes of the report.
Json explanations(const Json& report)
{
    std::set<std::string> codes;
    for (const char* key : {"failures", "messages"})
        for (const Json& message : getElements(report, key))
            codes.insert(message.value("code", ""));
    Json texts = Json::object();
    for (const IssueInfo& info : allIssues())
        if (codes.contains(formatCode(info)))
            texts[formatCode(info)] = {{"summary", info.summary}, {"hint", info.hint}};
    return texts;
}

/// Return the settings that make each cooker cheaper: key, option of hearth cook, and advice.
Json savings()
{
    Json of_cooker = Json::object();
    for (const cookers::Cooker& cooker : cookers::allCookers())
        for (const settings::Setting& setting : cooker.settings)
            if (!setting.saving.empty())
                of_cooker[std::string(cooker.name)].push_back(
                    Json::array({setting.key, setting.option, setting.saving}));
    return of_cooker;
}

uint64_t sumBytes(const Json& mesh)
{
    return mesh.value("bytes", Json::object()).value("pages_stored", uint64_t{0});
}

Json makeMeshes(const Json& asset)
{
    const Json clusters = asset.value("clusters", Json());
    return clusters.is_object() ? getElements(clusters, "meshes") : Json::array();
}

/// type  "jpeg" or "png"
std::string dataUri(const std::string& image, const std::string& type)
{
    return image.empty() ? "" : "data:image/" + type + ";base64," + base64(image);
}

} // namespace

std::string pageData(const std::string& report_text)
{
    const Json report = Json::parse(report_text).value();
    Json data;
    for (const char* key : {"tool", "started", "status", "exit", "output", "up_to_date", "totals", "skipped",
                            "failures", "error"})
        if (report.contains(key))
            data[key] = report[key];
    for (const char* key : {"assets", "meshes", "proxies", "textures", "stages"})
        data[key] = Json::array();
    const Json assets = getElements(report, "assets");
    for (size_t i = 0; i < assets.size(); ++i)
    {
        data["assets"].push_back(makeAsset(assets[i]));
        for (const Json& mesh : makeMeshes(assets[i]))
            data["meshes"].push_back(meshRow(mesh, i));
        for (const Json& proxy : getElements(assets[i], "proxies"))
            data["proxies"].push_back(proxyRow(proxy, i));
        for (const Json& texture : getElements(assets[i], "textures"))
            data["textures"].push_back(textureRow(texture, i));
    }
    // stages that belong to no asset
    for (const cookers::Cooker& cooker : cookers::allCookers())
        if (cooker.scope == settings::Scope::pack && report.contains(cooker.name))
            data["stages"].push_back(stageRow(report[cooker.name]));
    if (const Json budget = report.value("budget", Json::object()); budget.contains("share"))
        data["texture_budget"] = budget["share"];
    if (const Json receivers = report.value("receivers", Json::object()); receivers.contains("atlas"))
        data["receivers"] = receivers["atlas"];
    data["explain"] = explanations(report);
    data["savings"] = savings();
    return data.dump();
}

std::vector<PackMesh> importantMeshes(const std::string& report_text)
{
    const Json report = Json::parse(report_text).value();
    struct RankedMesh
    {
        PackMesh mesh;
        uint64_t bytes;
        bool is_largest; ///< largest mesh of its asset
    };
    std::vector<RankedMesh> ranked;
    for (const Json& asset : getElements(report, "assets"))
    {
        const size_t first = ranked.size();
        for (const Json& mesh : makeMeshes(asset))
            ranked.push_back(
                {{static_cast<uint32_t>(ranked.size()), mesh.value("name", "")}, sumBytes(mesh), false});
        const auto largest =
            std::max_element(ranked.begin() + static_cast<std::ptrdiff_t>(first), ranked.end(),
                             [](const RankedMesh& a, const RankedMesh& b) { return a.bytes < b.bytes; });
        if (largest != ranked.end())
            largest->is_largest = true;
    }
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const RankedMesh& a, const RankedMesh& b)
                     { return std::pair(a.is_largest, a.bytes) > std::pair(b.is_largest, b.bytes); });
    std::vector<PackMesh> meshes;
    for (RankedMesh& mesh : ranked)
        meshes.push_back(std::move(mesh.mesh));
    return meshes;
}

std::string imagesData(const Images& images, const std::vector<LightImage>& light)
{
    Json data{{"views", images.views},    {"is_sheet", images.is_sheet}, {"scene", Json::array()},
              {"meshes", Json::object()}, {"left_out", images.left_out}, {"why", images.why_left_out}};
    for (const std::string& jpeg : images.scene)
        data["scene"].push_back(dataUri(jpeg, "jpeg"));
    for (const auto& [mesh, jpegs] : images.meshes)
        for (const std::string& jpeg : jpegs)
            data["meshes"][std::to_string(mesh)].push_back(dataUri(jpeg, "jpeg"));
    data["light"] = Json::array();
    for (const LightImage& image : light)
    {
        Json facts = Json::array();
        for (const auto& [name, value] : image.facts)
            facts.push_back(Json::array({name, value}));
        data["light"].push_back(
            {{"name", image.name}, {"picture", dataUri(image.png, "png")}, {"facts", facts}});
    }
    return data.dump();
}

} // namespace hearth::report
