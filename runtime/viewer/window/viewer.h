// hearth-view without its command line: a window that shows a pack. README.md lists the keys.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/window/file_version.h"
#include "runtime/viewer/window/imgui_layer.h"
#include "runtime/viewer/window/options.h"
#include "runtime/viewer/window/panel.h"
#include "runtime/viewer/window/shown_pack.h"

namespace hearth::viewer
{

/// One at a time per process. Owns the window and the panel, writes the files; events come from SDL's queue.
class Viewer
{
public:
    /// Show the file of the options, and show it anew whenever it is replaced.
    /// errors: device; those of ShownPack::open and gpu::Renderer::upload.
    static Result<std::unique_ptr<Viewer>> create(const ViewOptions& options);
    /// pack  outlives the viewer
    /// errors: device; those of ShownPack::make and gpu::Renderer::upload.
    static Result<std::unique_ptr<Viewer>> create(const ViewOptions& options, const formats::PackView& pack);
    /// Wait for the frames.
    ~Viewer();

    /// True until somebody closes the window.
    bool isOpen() const { return open_; }

    /// Handle pending events, fly for a time step (at most a tenth of a second), advance clips, and show a
    /// frame. False if the window shows none now: it is minimized, or has just changed. errors:
    /// device_failed.
    Result<bool> step(double seconds);

    /// Handle no events, draw the frame without the panel, and write it as PNG. False if the window shows
    /// nothing now. errors: cannot_write, device_failed.
    Result<bool> saveScreenshot(const std::string& file);

    /// True if a frame from this serial on had all the geometry that it needed and could get.
    bool settledSince(uint64_t serial) const;
    uint64_t serial() const { return frames_->serial(); } ///< of the last frame

    ViewSettings& settings() { return settings_; }
    const FlyCamera& camera() const { return camera_; }
    const FrameStatistics& figures() const { return meter_->figures(); }
    const LoadedScene& scene() const { return *scene_; }
    const ShownPack& pack() const { return *shown_; }
    /// Return why the last budget, or the last version of the file, is not shown; or nothing.
    const std::string& problem() const { return problem_; }
    VkExtent2D extent() const { return swapchain_->extent(); }
    VulkanHost& host() { return *host_; }

private:
    Viewer(const ViewOptions& options, std::unique_ptr<ShownPack> shown);
    static Result<std::unique_ptr<Viewer>> create(const ViewOptions& options,
                                                  std::unique_ptr<ShownPack> shown);
    Status open();
    Status reloadIfReplaced();
    void keepChoices(ShownPack& pack);
    void handleEvents();
    void handle(const SDL_Event& event);
    void handleKey(int32_t key);
    Status applySettings();
    Status show(std::unique_ptr<LoadedScene> scene, std::unique_ptr<ShownPack> pack = nullptr);
    Status supportSettings();
    Status prepareLightMethod();
    gpu::Renderer& renderer() { return extended_renderer_ != nullptr ? *extended_renderer_ : *renderer_; }
    void lookAtAsset();
    Status resize();
    Result<bool> drawFrame(bool panel, const gpu::Buffer* screenshot);
    void buildPanel();
    Status poseScene();
    void recordFrame(VkCommandBuffer commands, uint32_t image, bool panel, const gpu::Buffer* screenshot);

    const ViewOptions options_;
    std::optional<FileVersion> file_version_; ///< that is shown, or was refused; none: no file
    std::unique_ptr<ShownPack> shown_;
    ViewSettings settings_;
    FrameSettings drawn_; ///< applied ones: targets and pipelines are prepared for them
    Panel panel_;
    FlyControls controls_;
    FlyCamera camera_;
    FramePose pose_;
    FrameLights lights_; ///< changes of the next frame
    SceneLampWeights lamp_weights_;
    std::optional<shared::Daylight> scene_daylight_{};   ///< that the scene has
    std::optional<gpu::DaylightChange> daylight_change_; ///< of the next frame
    std::optional<size_t> asset_;                        ///< selected one of the pack
    std::vector<gpu::InstanceMove> moves_;               ///< of the next frame
    std::span<const gpu::InstancePose> poses_{};         ///< of the next frame
    std::vector<gpu::ShadowSphere> shadow_spheres_;
    std::string problem_;
    bool open_ = true;
    bool minimized_ = false;
    bool resized_ = true; ///< the targets do not fit the window, or the frame
    gpu::LightMethod light_method_ = gpu::LightMethod::practical; ///< that is prepared
    double frame_seconds_ = 0;

    // each needs the ones before it
    std::unique_ptr<SdlWindow> window_;
    std::unique_ptr<VulkanHost> host_;
    std::unique_ptr<gpu::Renderer> renderer_;          ///< its device is that of all below
    std::unique_ptr<gpu::Renderer> extended_renderer_; ///< draws once it is there
    WindowTable vk_;
    std::unique_ptr<Swapchain> swapchain_;
    std::unique_ptr<FrameRing> frames_;
    std::unique_ptr<FrameMeter> meter_;
    std::unique_ptr<ImguiLayer> imgui_;
    std::unique_ptr<LoadedScene> scene_;
    std::optional<gpu::FrameTargets> targets_; ///< none: the window has no area
};

} // namespace hearth::viewer
