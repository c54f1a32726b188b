// Pack that a window shows, with all that the window makes of its tables.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/shadow_plan.h"
#include "runtime/pack/light_player.h"
#include "runtime/pack/pack.h"
#include "runtime/viewer/window/asset_views.h"
#include "runtime/viewer/window/lamp_weights.h"
#include "runtime/viewer/window/options.h"
#include "runtime/viewer/window/panel.h"
#include "runtime/viewer/window/playback.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hearth::viewer
{

class ShownPack
{
public:
    /// Prepare a pack that outlives this.
    /// errors: those of checkPack, findClip, chooseCamera and listLampControls.
    static Result<std::unique_ptr<ShownPack>> make(const ViewOptions& options, const formats::PackView& pack);

    /// Map the file of the options, and prepare it. errors: those of make and pack::Pack::open.
    static Result<std::unique_ptr<ShownPack>> open(const ViewOptions& options);

    const formats::PackView& view() const { return view_; }
    uint64_t geometryBytes() const; ///< decoded, of all pages

    pack::PosePlayer player;
    pack::LightPlayer light_player;
    Playback playback;
    std::vector<std::string> clips; ///< names of the animations
    /// Cameras to go to; the first is the start camera, the second shows the whole scene.
    std::vector<NamedCamera> cameras{};
    AssetViews assets{};
    std::vector<LampControl> lamps{}; ///< under the weights of the options
    gpu::ShadowOptions shadows{};

private:
    /// owner  of the view; null: somebody else
    ShownPack(std::unique_ptr<const pack::Pack> owner, const formats::PackView& view,
              std::optional<pack::ClipTime> clip, double seconds);
    static Result<std::unique_ptr<ShownPack>>
    make(const ViewOptions& options, std::unique_ptr<const pack::Pack> owner, const formats::PackView& view);

    std::unique_ptr<const pack::Pack> owner_;
    const formats::PackView& view_;
};

/// Return a fly speed in metres per second that reaches most of the scene in a few seconds: a quarter of the
/// median distance of the instances. Their bounds would include a sky dome.
float flySpeed(const formats::PackView& pack, Float3 eye);

} // namespace hearth::viewer
