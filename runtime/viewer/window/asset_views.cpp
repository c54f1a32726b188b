// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/asset_views.h"

#include "runtime/pack/scene_boxes.h"
#include "runtime/viewer/contact_sheet.h"

#include <cstdio>

namespace hearth::viewer
{

namespace
{

std::string nameWithSize(const formats::PackView& pack, const formats::AssetRecord& asset)
{
    char size[32];
    std::snprintf(size, sizeof(size), ", %.3g m", double{formats::largestSide(asset)});
    return std::string(pack.text(asset.name)) + size;
}

} // namespace

AssetViews makeAssetViews(const formats::PackView& pack, const pack::PosePlayer& player, float aspect)
{
    const std::vector<uint32_t> drawn = drawnAssets(pack);
    AssetViews views;
    if (drawn.size() < 2)
        return views;
    std::vector<formats::Range> parts{pack::allInstances(pack)};
    for (const uint32_t asset : drawn)
        parts.push_back(pack.assets()[asset].instances);
    Stage stage = Stage::fromInstances(pack, player, parts, aspect);
    for (size_t i = 0; i < drawn.size(); ++i)
        views.list.push_back(
            {nameWithSize(pack, pack.assets()[drawn[i]]), stage.cameras()[AssetViews::partIndex(i)]});
    if (areUnplaced(pack))
        views.stage = std::move(stage);
    return views;
}

} // namespace hearth::viewer
