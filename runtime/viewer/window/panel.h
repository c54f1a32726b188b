// Settings and statistics panel of the window.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/frame_settings.h"
#include "runtime/viewer/window/asset_views.h"
#include "runtime/viewer/window/fly_camera.h"
#include "runtime/viewer/window/frame_meter.h"
#include "runtime/viewer/window/lamp_weights.h"
#include "runtime/viewer/window/playback.h"

namespace hearth::viewer
{

/// Settings of the panel; the frame loop applies them.
struct ViewSettings
{
    FrameSettings frame;
    PlaybackSettings playback{};
    uint64_t memory_budget = 0; ///< bytes; 0: all geometry is resident
    bool count_culling = false;
    bool panel = true;
    std::optional<size_t> camera{};   ///< request: go to this one of PanelData::cameras
    std::vector<LampControl> lamps{}; ///< of the pack
    std::optional<shared::Daylight> daylight{};
    std::optional<size_t> asset{}; ///< this one of PanelData::assets; none: the whole scene
};

struct NamedCamera
{
    std::string name;
    shared::Camera camera;
};

/// Values that the panel displays.
struct PanelData
{
    const std::string& device;
    VkExtent2D extent;
    double frame_seconds; ///< from one frame to the next
    const FrameStatistics& figures;
    const LoadedScene& scene;
    VkDeviceSize target_bytes;
    const FlyCamera& camera;
    std::span<const NamedCamera> cameras;
    std::span<const AssetView> assets;
    const Playback& playback;
    std::span<const std::string> clips; ///< names of the pack's animations
    const std::string& problem;         ///< as of Viewer::problem
};

class Panel
{
public:
    /// settings        initial settings
    /// geometry_bytes  of the whole pack, which sets the range of budgets
    Panel(const ViewSettings& settings, uint64_t geometry_bytes);

    /// Build within a frame of ImguiLayer. The resulting settings are valid.
    void build(ViewSettings& settings, const PanelData& facts);

private:
    void buildImage(FrameSettings& settings, const PanelData& facts);
    void buildCurve(FrameSettings& settings);
    void buildStreaming(ViewSettings& settings, const PanelData& facts);
    void buildCulling(ViewSettings& settings, const PanelData& facts);

    int max_budget_mib_;
    bool streamed_; ///< state of the panel's checkbox
    int budget_mib_;
    std::vector<shared::LodKnot> curve_; ///< being edited, perhaps invalid
    std::string curve_problem_;
};

} // namespace hearth::viewer
