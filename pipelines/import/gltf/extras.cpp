// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/extras.h"

#include "formats/records/extras.h"
#include "pipelines/import/gltf/document/json_source.h"
#include "pipelines/import/gltf/document/places.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace hearth::import
{

using namespace formats;

namespace
{

/// Object of the source: its kind and its index in the source.
using SourceObject = std::pair<ExtrasOwner, uint32_t>;

class ExtrasWriter
{
public:
    ExtrasWriter(const JsonDocument& document, const GltfModel& model, const MeshUses& uses,
                 const GltfContext& context)
        : root_(document.root()), model_(model), uses_(uses), context_(context)
    {
    }

    Status write(std::string_view text);

private:
    void find();
    void findInArray(const std::optional<Json>& array, ExtrasOwner owner);
    void findIn(const std::optional<Json>& object, SourceObject owner);
    void dropUnused();
    Status cut(std::string_view text);
    void writeRecord(ExtrasOwner owner, size_t index, uint32_t source_index);
    template <typename Records>
    void writeTable(const Records& records, ExtrasOwner owner)
    {
        for (size_t i = 0; i < records.size(); ++i)
            writeRecord(owner, i, static_cast<uint32_t>(i));
    }
    void writeRecords();
    void findOthers(const JsonPath& path, PlaceList& others) const;

    uint32_t sourceCamera(const CameraRecord& record) const { return model_.nodes[record.node].camera; }
    uint32_t sourceLight(const LightRecord& record) const { return model_.nodes[record.node].light; }

    Json root_;
    const GltfModel& model_;
    const MeshUses& uses_;
    const GltfContext& context_;
    std::map<SourceObject, Json> extras_;
    std::map<SourceObject, StringRef> texts_;
    std::vector<uint32_t> positions_; ///< of the extras that are kept, ascending
};

void ExtrasWriter::findIn(const std::optional<Json>& object, SourceObject owner)
{
    if (const std::optional<Json> extras = object ? object->find("extras") : std::nullopt)
        extras_.emplace(owner, *extras);
}

void ExtrasWriter::findInArray(const std::optional<Json>& array, ExtrasOwner owner)
{
    for (uint32_t i = 0; array && i < array->size(); ++i)
        findIn((*array)[i], {owner, i});
}

/// Find the extras of all objects of the kinds that are kept.
void ExtrasWriter::find()
{
    findInArray(root_.find("nodes"), ExtrasOwner::node);
    findInArray(root_.find("meshes"), ExtrasOwner::mesh);
    findInArray(root_.find("materials"), ExtrasOwner::material);
    findInArray(root_.find("cameras"), ExtrasOwner::camera);
    findInArray(root_.find("skins"), ExtrasOwner::skin);
    findInArray(root_.find("animations"), ExtrasOwner::animation);
    const std::optional<Json> extensions = root_.find("extensions");
    const std::optional<Json> lights = extensions ? extensions->find("KHR_lights_punctual") : std::nullopt;
    findInArray(lights ? lights->find("lights") : std::nullopt, ExtrasOwner::light);
    findIn(root_.find("asset"), {ExtrasOwner::asset, 0});
    if (!model_.scenes.empty())
        findIn((*root_.find("scenes"))[model_.scene == kInvalidIndex ? 0 : model_.scene],
               {ExtrasOwner::scene, 0});
    findIn(root_, {ExtrasOwner::file, 0});
}

/// Remove the extras of cameras and lights that no drawn node has: the part does not have them.
void ExtrasWriter::dropUnused()
{
    std::vector<bool> cameras(model_.cameras.size()), lights(model_.lights.size());
    for (const CameraRecord& record : context_.part.cameras)
        cameras[sourceCamera(record)] = true;
    for (const LightRecord& record : context_.part.lights)
        lights[sourceLight(record)] = true;
    std::erase_if(extras_,
                  [&](const auto& entry)
                  {
                      const auto [owner, index] = entry.first;
                      return (owner == ExtrasOwner::camera && !cameras[index]) ||
                             (owner == ExtrasOwner::light && !lights[index]);
                  });
}

/// Add the texts to the part's strings.
Status ExtrasWriter::cut(std::string_view text)
{
    for (const auto& [owner, json] : extras_)
        positions_.push_back(json.position());
    std::sort(positions_.begin(), positions_.end());
    const std::vector<std::string> cut_texts = cutValues(text, positions_);
    for (const auto& [owner, json] : extras_)
    {
        const auto at = std::lower_bound(positions_.begin(), positions_.end(), json.position());
        const std::string& cut_text = cut_texts[static_cast<size_t>(at - positions_.begin())];
        if (cut_text.size() > kMaxExtrasBytes)
            return context_.error(
                Issue::input_too_large, json.pointer(),
                fmt::format(
                    "extras of {} bytes, at most {} are kept; put so much data into a file of its own",
                    cut_text.size(), kMaxExtrasBytes));
        texts_.emplace(owner, context_.part.intern(cut_text));
    }
    return success();
}

void ExtrasWriter::writeRecord(ExtrasOwner owner, size_t index, uint32_t source_index)
{
    if (const auto text = texts_.find({owner, source_index}); text != texts_.end())
        context_.part.extras.push_back(
            {static_cast<uint32_t>(owner), static_cast<uint32_t>(index), text->second});
}

/// Write a record for each object of the part, by owner and index. A mesh, a camera and a light may be there
/// several times.
void ExtrasWriter::writeRecords()
{
    writeTable(model_.nodes, ExtrasOwner::node);
    for (size_t i = 0; i < uses_.uses.size(); ++i)
        writeRecord(ExtrasOwner::mesh, i, uses_.uses[i].mesh);
    writeTable(model_.materials, ExtrasOwner::material);
    for (size_t i = 0; i < context_.part.cameras.size(); ++i)
        writeRecord(ExtrasOwner::camera, i, sourceCamera(context_.part.cameras[i]));
    for (size_t i = 0; i < context_.part.lights.size(); ++i)
        writeRecord(ExtrasOwner::light, i, sourceLight(context_.part.lights[i]));
    writeTable(model_.skins, ExtrasOwner::skin);
    writeTable(model_.animations, ExtrasOwner::animation);
    for (const ExtrasOwner owner : {ExtrasOwner::asset, ExtrasOwner::scene, ExtrasOwner::file})
        writeRecord(owner, 0, 0);
}

/// Find the extras that are not kept, at `path` and below.
void ExtrasWriter::findOthers(const JsonPath& path, PlaceList& others) const
{
    for (size_t i = 0; i < path.value.size(); ++i)
    {
        const JsonPath child{&path, path.value[i], i};
        if (!path.value.isObject() || child.value.key() != "extras")
            findOthers(child, others);
        else if (!std::binary_search(positions_.begin(), positions_.end(), child.value.position()))
            others.add(path);
    }
}

Status ExtrasWriter::write(std::string_view text)
{
    find();
    dropUnused();
    HEARTH_TRY(cut(text));
    writeRecords();
    PlaceList others;
    findOthers({nullptr, root_, 0}, others);
    if (!others.empty())
        context_.part.warn(Issue::dropped, others.first(),
                           "extras of this object are not kept" + others.list());
    return success();
}

} // namespace

Status writeExtras(const JsonDocument& document, std::string_view text, const GltfModel& model,
                   const MeshUses& uses, const GltfContext& context)
{
    return ExtrasWriter(document, model, uses, context).write(text);
}

} // namespace hearth::import
