// hearth-receivers: light of all sources' lamps, baked into texels of their instances.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/words.h"
#include "pipelines/settings/make_setting.h"

namespace hearth::cookers
{

namespace
{

using namespace settings;

/// Make the switch. It has no auto: only the game knows whether it dims its lamps.
Setting makeReceiverSwitch()
{
    Setting setting = choiceSetting("receivers.mode",
                                    "bake the light of each lamp into texels, so that a game may dim, colour "
                                    "and switch lamps whose light was baked",
                                    "off", {"on", "off"});
    setting.bare_choice = "on";
    setting.option = "--receivers";
    return setting;
}

std::vector<Setting> makeReceiverSettings()
{
    return {
        makeReceiverSwitch(),
        withSaving("a lower density takes fewer rays",
                   numberSetting("receivers.texels_per_metre", "density of texels that receive light", "16",
                                 1.0 / 1024, 1024)),
        wholeNumberSetting("receivers.lights",
                           "lamps that a texel keeps at most; with 3 a texel is one record of 16 bytes", "12",
                           2, 12),
        choiceSetting("receivers.codec", "code of the colours of texels", "rgb9e5", {"rgb9e5", "rgbm"}),
        withSaving("a few bounces take less time",
                   wholeNumberSetting("receivers.bounces",
                                      "bounces of light at most; fewer where they change nothing", "32", 0,
                                      256)),
    };
}

Result<Arguments> makeReceiverArguments(const Values& values)
{
    Arguments arguments;
    // rays through the scene
    arguments.depends_on_processor = true;
    addOption(values, "receivers.texels_per_metre", "--texels-per-metre", arguments);
    addOption(values, "receivers.lights", "--lights", arguments);
    addOption(values, "receivers.codec", "--codec", arguments);
    addOption(values, "receivers.bounces", "--bounces", arguments);
    return arguments;
}

} // namespace

Cooker describeReceivers()
{
    return {.name = "receivers",
            .scope = Scope::pack,
            .switched_by = "receivers.mode",
            .reads = {"import", "clusters", "textures"},
            .reads_of_pack = {"probe", "bricks"},
            .link_option = "--receivers",
            .has_statistics = true,
            .settings = makeReceiverSettings(),
            .makeArguments = makeReceiverArguments,
            // the generated room, a GLB of 2 MB
            .cost = {64 * kMiB, 40, 20}};
}

} // namespace hearth::cookers
