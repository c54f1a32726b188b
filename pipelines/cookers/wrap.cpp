// hearth-wrap: closed surfaces around the meshes of a source, for their proxies. A package of its own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/registry.h"
#include "pipelines/cookers/words.h"
#include "pipelines/settings/make_setting.h"

namespace hearth::cookers
{

namespace
{

using namespace settings;

std::vector<Setting> makeWrapSettings()
{
    return {
        withOption(
            numberSetting("proxy.alpha",
                          "radius of the largest hole that a wrapped proxy closes, over the diagonal of "
                          "the mesh's box",
                          "0.02", 0.0005, 1),
            "--proxy-alpha", "SHARE"),
        withOption(
            numberSetting("proxy.offset",
                          "distance of a wrapped proxy from its mesh, over the diagonal of the mesh's box",
                          "0.0017", 0.00001, 1),
            "--proxy-offset", "SHARE"),
    };
}

Result<Arguments> makeWrapArguments(const Values& values)
{
    Arguments arguments;
    addOption(values, "proxy.alpha", "--alpha", arguments);
    addOption(values, "proxy.offset", "--offset", arguments);
    addOption(values, "proxy.error", "--error", arguments);
    addOption(values, "proxy.triangles", "--triangles", arguments);
    return arguments;
}

} // namespace

Cooker describeWrap()
{
    return {.name = "wrap",
            .has_package_of_its_own = true,
            .switched_by = kProxyFrom,
            .runsFor = [](const Values& values) { return getProxyFrom(values) == "wrap"; },
            .reads = {"import"},
            .is_linked = false,
            .has_statistics = true,
            .settings = makeWrapSettings(),
            .makeArguments = makeWrapArguments,
            .cost = {64 * kMiB, 16, 1}};
}

} // namespace hearth::cookers
