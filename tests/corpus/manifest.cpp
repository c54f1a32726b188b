// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/corpus/manifest.h"

#include "cook/json/json.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace hearth::corpus
{

namespace
{

// Valid files have no limits in the manifest. The largest has 1.6 million triangles.
constexpr Limits kGoodLimits{120, uint64_t{4} << 30};

const AssetClass* findClass(const std::string& name)
{
    const auto* const end = std::end(kAssetClasses);
    const auto* const found = std::find_if(std::begin(kAssetClasses), end,
                                           [&](const AssetClass& known) { return known.name == name; });
    return found == end ? nullptr : found;
}

Confidence readConfidence(const Json& entry)
{
    if (!entry.contains("confidence"))
        return Confidence::good;
    return entry.at("confidence") == "high" ? Confidence::high : Confidence::medium;
}

Limits readLimits(const Json& entry)
{
    if (!entry.contains("limits"))
        return kGoodLimits;
    const Json& limits = entry.at("limits");
    return {limits.at("seconds").get<double>(), limits.at("rss_mb").get<uint64_t>() << 20};
}

std::map<std::string, uint64_t> countSamples(const Json& entry)
{
    std::map<std::string, uint64_t> counts;
    const Json all = entry.value("counts", Json::object());
    for (const auto& [name, value] : all.items())
        if (value.is_number_unsigned())
            counts[name] = value.get<uint64_t>();
    return counts;
}

Asset makeAsset(const Json& entry, const std::string& assets_folder)
{
    Asset asset;
    asset.file = entry.at("file").get<std::string>();
    asset.path = assets_folder + "/" + asset.file;
    asset.folder = std::filesystem::path(asset.path).parent_path().string();
    asset.category = entry.contains("category") ? entry.at("category").get<std::string>()
                                                : entry.at("stratum").get<std::string>();
    asset.expected = findClass(entry.at("expected").get<std::string>());
    asset.confidence = readConfidence(entry);
    asset.limits = readLimits(entry);
    asset.bytes = entry.at("bytes").get<uint64_t>();
    asset.self_contained = entry.at("files").empty();
    asset.counts = countSamples(entry);
    return asset;
}

} // namespace

const char* confidenceName(Confidence confidence)
{
    switch (confidence)
    {
    case Confidence::good:
        return "good";
    case Confidence::high:
        return "high";
    case Confidence::medium:
        return "medium";
    }
    return "";
}

Result<std::vector<Asset>> readManifest(const std::string& folder)
{
    std::error_code ignored;
    const std::string root = std::filesystem::canonical(folder, ignored).string();
    const std::string path = root + "/manifest.json";
    std::ifstream file(path, std::ios::binary);
    if (root.empty() || !file)
        return Error{Issue::input_missing, folder + "/manifest.json", "", "cannot be read"};

    const std::string text(std::istreambuf_iterator<char>(file), {});
    const std::optional<Json> manifest = Json::parse(text);
    if (!manifest)
        return Error{Issue::json_syntax, path, "", ""};
    std::vector<Asset> assets;
    try
    {
        for (const char* half : {"good", "bad"})
            for (const Json& entry : manifest->at(half))
            {
                assets.push_back(makeAsset(entry, root));
                if (assets.back().expected == nullptr)
                    return Error{Issue::gltf_value, path, assets.back().file, "a class that is not known"};
            }
    }
    catch (const JsonError& error)
    {
        return Error{Issue::json_syntax, path, "", error.what()};
    }
    return assets;
}

} // namespace hearth::corpus
