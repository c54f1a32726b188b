// What can be set and read on the window.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/frame_settings.h"
#include "runtime/viewer/window/asset_views.h"
#include "runtime/viewer/window/fly_camera.h"
#include "runtime/viewer/window/frame_meter.h"
#include "runtime/viewer/window/playback.h"

namespace hearth::viewer
{

/// What a person sets. Whoever draws the frames acts on it.
struct ViewSettings
{
    FrameSettings frame;
    PlaybackSettings playback{};
    uint64_t geometry_budget = 0; ///< bytes; 0: all geometry is resident
    bool count_culling = false;
    bool panel = true;
    std::optional<size_t> camera{}; ///< go to this one of PanelFacts::cameras
    std::optional<size_t> asset{};  ///< look at this one of PanelFacts::assets; none: at the whole scene
};

struct NamedCamera
{
    std::string name;
    shared::Camera camera;
};

/// What the panel tells.
struct PanelFacts
{
    const std::string& device;
    VkExtent2D extent;
    double frame_seconds; ///< from one picture to the next
    const FrameFigures& figures;
    const LoadedScene& scene;
    VkDeviceSize target_bytes;
    const FlyCamera& camera;
    std::span<const NamedCamera> cameras;
    std::span<const AssetView> assets;
    const Playback& playback;
    std::span<const std::string> clips; ///< what people call the animations of the pack
    const std::string& problem;         ///< why the last budget was not taken; or empty
};

class Panel
{
public:
    /// settings        where the panel starts
    /// geometry_bytes  of the whole pack, which sets the range of budgets
    Panel(const ViewSettings& settings, uint64_t geometry_bytes);

    /// Within a frame of ImguiLayer. What is set is valid.
    void build(ViewSettings& settings, const PanelFacts& facts);

private:
    void buildPicture(FrameSettings& settings, const gpu::Scene& scene);
    void buildCurve(FrameSettings& settings);
    void buildStreaming(ViewSettings& settings, const PanelFacts& facts);
    void buildCulling(ViewSettings& settings, const PanelFacts& facts);

    int largest_budget_mib_;
    bool streamed_; ///< as it stands on the panel
    int budget_mib_;
    std::vector<shared::LodKnot> curve_; ///< as it is being edited, perhaps not one that can be drawn
    std::string curve_problem_;
};

} // namespace hearth::viewer
