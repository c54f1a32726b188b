// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/pack_check.h"

#include "formats/pack/check_tools.h"

namespace hearth::formats
{

namespace check
{

namespace
{

/// Return the length of the UTF-8 character at `text[0]`, or 0 if it is invalid (also surrogates, overlong
/// forms).
size_t characterLength(std::string_view text)
{
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    if (first < 0x80)
        return 1;
    const size_t length = first >= 0xC2 && first < 0xE0 ? 2 : first >= 0xE0 && first < 0xF0 ? 3 : 4;
    if (first < 0xC2 || first > 0xF4 || text.size() < length)
        return 0;
    for (size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80)
            return 0;
    const bool overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
    const bool surrogate = first == 0xED && byte(1) > 0x9F;
    const bool beyond = first == 0xF4 && byte(1) > 0x8F;
    return overlong || surrogate || beyond ? 0 : length;
}

Status checkUtf8(const PackView& view, uint32_t chunk, std::string_view text)
{
    for (size_t at = 0; at < text.size();)
    {
        const size_t length = characterLength(text.substr(at));
        if (length == 0)
            return Error{Issue::meaning_text, view.name(), chunkName(chunk, 0), "byte " + std::to_string(at)};
        at += length;
    }
    return success();
}

/// Check that names, or other texts of records, lie inside the string table and split no character.
template <typename Record>
Status checkNames(const PackView& view, const char* kind, std::span<const Record> records,
                  StringRef Record::*text = &Record::name)
{
    const std::string_view all = view.strings();
    const auto cuts = [&](size_t at)
    { return at < all.size() && (static_cast<unsigned char>(all[at]) & 0xC0) == 0x80; };
    for (size_t i = 0; i < records.size(); ++i)
    {
        const StringRef name = records[i].*text;
        if (!isInsideTable({name.offset, name.length}, all.size()))
            return makeError(view, Issue::meaning_range, kind, i, "its text lies outside chunk STRS");
        if (cuts(name.offset) || cuts(size_t{name.offset} + name.length))
            return makeError(view, Issue::meaning_text, kind, i,
                             "its text cuts a character of chunk STRS in two");
    }
    return success();
}

Status checkClusterMaterials(const PackView& view)
{
    for (size_t i = 0; i < view.clusters().size(); ++i)
        if (!isNoneOrBelow(view.clusters()[i].material, view.materials().size()))
            return makeError(view, Issue::meaning_reference, "cluster", i,
                             "material " + std::to_string(view.clusters()[i].material) + " of " +
                                 std::to_string(view.materials().size()));
    return success();
}

} // namespace

Status checkTexts(const PackView& view)
{
    HEARTH_TRY(checkUtf8(view, kChunkMeta, view.meta()));
    HEARTH_TRY(checkUtf8(view, kChunkStrings, view.strings()));
    HEARTH_TRY(checkNames(view, "asset", view.assets()));
    HEARTH_TRY(checkNames(view, "material", view.materials()));
    HEARTH_TRY(checkNames(view, "image", view.images()));
    HEARTH_TRY(checkNames(view, "skin", view.skins()));
    HEARTH_TRY(checkNames(view, "animation", view.animations()));
    HEARTH_TRY(checkNames(view, "node", view.nodes()));
    HEARTH_TRY(checkNames(view, "camera", view.cameras()));
    HEARTH_TRY(checkNames(view, "light", view.lights()));
    HEARTH_TRY(checkNames(view, "mesh", view.meshes()));
    HEARTH_TRY(checkNames(view, "extras", view.extras(), &ExtrasRecord::json));
    return checkNames(view, "authored level", view.authoredLevels());
}

} // namespace check

void serialPageLoop(uint32_t count, const std::function<void(uint32_t)>& work)
{
    for (uint32_t page = 0; page < count; ++page)
        work(page);
}

Status checkHierarchy(const PackView& view, const PageLoop& loop)
{
    HEARTH_TRY(check::checkMeshTables(view));
    HEARTH_TRY(check::checkPageTables(view, check::BulkData::read));
    return check::checkPageGeometry(view, loop);
}

Status checkAnimationTables(const PackView& view)
{
    HEARTH_TRY(check::checkSkins(view));
    HEARTH_TRY(check::checkAnimations(view));
    return check::checkNodeTree(view);
}

Status checkSpecular(const PackView& view)
{
    return check::checkSpecularTable(view);
}

Status checkProbes(const PackView& view)
{
    return check::checkProbeTables(view);
}

Status checkReceivers(const PackView& view)
{
    return check::checkReceiverTables(view);
}

Status checkProxies(const PackView& view)
{
    return check::checkProxyTables(view);
}

Status checkBricks(const PackView& view)
{
    return check::checkBrickTables(view);
}

namespace
{

/// Check a pack.
/// check_hierarchy  checks meshes, pages and their tables
template <typename CheckHierarchy>
Status checkPackWith(const PackView& view, check::BulkData bulk, const CheckHierarchy& check_hierarchy)
{
    if (view.container().kind() != ContainerKind::pack)
        return Error{Issue::container_kind, view.name(), "", "this is a part, not a pack"};
    HEARTH_TRY(check::checkTexts(view));
    HEARTH_TRY(check::checkMaterials(view));
    HEARTH_TRY(check::checkImages(view, bulk));
    HEARTH_TRY(checkAnimationTables(view));
    HEARTH_TRY(check::checkNodeMeshes(view));
    HEARTH_TRY(check::checkInstances(view));
    HEARTH_TRY(check::checkCameras(view));
    HEARTH_TRY(check::checkLights(view));
    HEARTH_TRY(check::checkShadowSpheres(view));
    HEARTH_TRY(check_hierarchy());
    HEARTH_TRY(check::checkClusterMaterials(view));
    HEARTH_TRY(check::checkAuthoredLevels(view));
    HEARTH_TRY(check::checkDeformedMeshes(view));
    HEARTH_TRY(check::checkAssets(view));
    HEARTH_TRY(check::checkExtras(view));
    HEARTH_TRY(checkProxies(view));
    HEARTH_TRY(check::checkProxyReferences(view));
    HEARTH_TRY(checkSpecular(view));
    HEARTH_TRY(checkProbes(view));
    HEARTH_TRY(checkReceivers(view));
    HEARTH_TRY(check::checkReceiverReferences(view));
    HEARTH_TRY(check::checkSurroundings(view));
    HEARTH_TRY(checkBricks(view));
    return check::checkFaceReferences(view);
}

} // namespace

Status checkPack(const PackView& view, const PageLoop& loop)
{
    return checkPackWith(view, check::BulkData::read, [&] { return checkHierarchy(view, loop); });
}

Status checkTables(const PackView& view)
{
    return checkPackWith(view, check::BulkData::skip,
                         [&]() -> Status
                         {
                             HEARTH_TRY(check::checkMeshTables(view));
                             return check::checkPageTables(view, check::BulkData::skip);
                         });
}

} // namespace hearth::formats
