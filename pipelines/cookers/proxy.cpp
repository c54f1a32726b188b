// hearth-proxy: simple, clean meshes that stand for the meshes of a source.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/registry.h"
#include "pipelines/cookers/words.h"
#include "pipelines/settings/make_setting.h"

namespace hearth::cookers
{

namespace
{

using namespace settings;

constexpr std::string_view kBindings = "proxy.bindings";
constexpr std::string_view kAuthored = "authored";

std::vector<Setting> makeProxySettings()
{
    return {
        withOption(
            choiceSetting(
                std::string(kProxyFrom),
                "proxies of meshes, for collision and as occluders: authored, those of the source alone, "
                "called "
                "X_PROXY or UCX_X; for meshes without them, clean, the mesh repaired and decimated, or wrap, "
                "a closed surface around it; source, none",
                kAuthored, {kAuthored, "source", "clean", "wrap"}),
            "--proxy-from", "NAME"),
        withOption(
            numberSetting("proxy.error",
                          "error of the cut that a clean proxy is made from, and how far a wrapped one "
                          "is moved to have fewer triangles, over the diagonal of the mesh's box; 0: "
                          "the whole mesh, the whole wrap",
                          "0.002", 0, 1),
            "--proxy-error", "SHARE"),
        withOption(wholeNumberSetting("proxy.triangles",
                                      "triangles of that cut, at most; a wrap has more where it must",
                                      "no limit", 1, 0x1p32),
                   "--proxy-triangles", "COUNT"),
        withOption(
            numberSetting("proxy.holes",
                          "holes of a clean proxy are filled whose boundary is at most this long, over the "
                          "diagonal; 0: none",
                          "0.05", 0, 16),
            "--proxy-holes", "SHARE"),
        withOption(wholeNumberSetting("proxy.convex_parts",
                                      "convex parts that take the place of a proxy's triangles, for physics, "
                                      "at most; 0: none",
                                      "0", 0, 1024),
                   "--proxy-convex-parts", "COUNT"),
        withOption(numberSetting("proxy.convex_error",
                                 "convex parts are made while they reach farther than this from the mesh, "
                                 "over the diagonal",
                                 "0.02", 0, 1),
                   "--proxy-convex-error", "SHARE"),
        flagSetting(std::string(kBindings), "store where the vertices of meshes are on their proxies",
                    "--proxy-bindings"),
    };
}

/// True if there is more to do than to take the proxies of the import part, which hearth-link does.
bool runsProxy(const Values& values)
{
    const std::string from = getProxyFrom(values);
    return from == "clean" || from == "wrap" || (from == kAuthored && isOn(values, kBindings));
}

Result<Arguments> makeProxyArguments(const Values& values)
{
    Arguments arguments;
    if (getProxyFrom(values) == kAuthored)
        arguments.words.emplace_back("--authored");
    else
        arguments.depends_on_processor = true; // rays decide which side of a shell is out
    addOption(values, "proxy.error", "--error", arguments);
    addOption(values, "proxy.triangles", "--triangles", arguments);
    addOption(values, "proxy.holes", "--holes", arguments);
    addOption(values, "proxy.convex_parts", "--convex-parts", arguments);
    addOption(values, "proxy.convex_error", "--convex-error", arguments);
    addFlag(values, kBindings, "--bindings", arguments);
    return arguments;
}

} // namespace

std::string getProxyFrom(const Values& values)
{
    return settings::choiceOr(values, kProxyFrom, kAuthored);
}

Cooker describeProxy()
{
    return {.name = "proxy",
            .switched_by = kProxyFrom,
            .runsFor = runsProxy,
            .reads = {"import", "clusters", "wrap"},
            .link_option = "--proxies",
            .has_statistics = true,
            .settings = makeProxySettings(),
            .makeArguments = makeProxyArguments,
            .cost = {16 * kMiB, 8, 0.05}};
}

} // namespace hearth::cookers
