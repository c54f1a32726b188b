// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/shown_pack.h"

#include "runtime/viewer/camera_fit.h"

#include <algorithm>

namespace hearth::viewer
{

namespace
{

std::vector<NamedCamera> listCameras(const formats::PackView& pack, const pack::PosePlayer& player,
                                     const shared::Camera& start, float aspect)
{
    std::vector<NamedCamera> cameras{{"start", start}, {"whole scene", fitCamera(pack, player, aspect)}};
    for (uint32_t i = 0; i < pack.cameras().size(); ++i)
        cameras.push_back({"scene camera " + std::to_string(i), sceneCamera(pack, i)});
    return cameras;
}

std::vector<std::string> clipNames(const formats::PackView& pack)
{
    std::vector<std::string> names;
    for (const formats::AnimationRecord& animation : pack.animations())
    {
        const std::string_view name = pack.text(animation.name);
        names.push_back(name.empty() ? std::to_string(names.size()) : std::string(name));
    }
    return names;
}

/// Fit the shadow options to flights between these cameras.
gpu::ShadowOptions fitShadowOptions(const ShadowSettings& settings, const formats::PackView& pack,
                                    std::span<const NamedCamera> named)
{
    std::vector<shared::Camera> cameras;
    for (const NamedCamera& camera : named)
        cameras.push_back(camera.camera);
    return fitShadows(settings, pack, cameras);
}

} // namespace

ShownPack::ShownPack(std::unique_ptr<const pack::Pack> owner, const formats::PackView& view,
                     std::optional<pack::ClipTime> clip, double seconds)
    : player(view),
      light_player(view),
      playback(clipDurations(view), clip, seconds),
      clips(clipNames(view)),
      owner_(std::move(owner)),
      view_(view)
{
}

Result<std::unique_ptr<ShownPack>> ShownPack::make(const ViewOptions& options, const formats::PackView& pack)
{
    return make(options, nullptr, pack);
}

Result<std::unique_ptr<ShownPack>> ShownPack::open(const ViewOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(pack::Pack pack, pack::Pack::open(options.pack));
    auto owner = std::make_unique<const pack::Pack>(std::move(pack));
    const formats::PackView& view = owner->view();
    return make(options, std::move(owner), view);
}

Result<std::unique_ptr<ShownPack>> ShownPack::make(const ViewOptions& options,
                                                   std::unique_ptr<const pack::Pack> owner,
                                                   const formats::PackView& view)
{
    HEARTH_TRY(checkPack(options, view));
    HEARTH_ASSIGN_OR_RETURN(const std::optional<pack::ClipTime> clip, findClip(options.animation, view));
    std::unique_ptr<ShownPack> shown(
        new ShownPack(std::move(owner), view, clip, options.animation.seconds.value_or(0)));
    shown->playback.pose(shown->player);
    HEARTH_ASSIGN_OR_RETURN(const shared::Camera start, chooseCamera(options, view, shown->player));
    HEARTH_ASSIGN_OR_RETURN(shown->lamps, listLampControls(view, options.lamps));
    const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
    shown->cameras = listCameras(view, shown->player, start, aspect);
    shown->assets = makeAssetViews(view, shown->player, aspect);
    shown->shadows = fitShadowOptions(options.shadows, view, shown->cameras);
    return shown;
}

uint64_t ShownPack::geometryBytes() const
{
    uint64_t bytes = 0;
    for (const formats::PageRecord& page : view_.pages())
        bytes += page.size;
    return bytes;
}

float flySpeed(const formats::PackView& pack, Float3 eye)
{
    std::vector<float> distances;
    for (const formats::InstanceRecord& instance : pack.instances())
    {
        const formats::MeshRecord& mesh = pack.meshes()[instance.mesh];
        const Float3 center = (mesh.box_min + mesh.box_max) * 0.5f;
        distances.push_back(length(transformPoint(instance.world_from_object, center) - eye));
    }
    if (distances.empty())
        return 1;
    const auto median = distances.begin() + static_cast<ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), median, distances.end());
    return std::max(*median / 4, 1e-4f);
}

} // namespace hearth::viewer
