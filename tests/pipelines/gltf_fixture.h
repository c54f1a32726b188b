// Small in-memory glTF documents, imported and read back.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"
#include "formats/container/container_reader.h"
#include "formats/records/scene.h"
#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace hearth::import::test
{

/// Folder that is removed at the end.
class TemporaryFolder
{
public:
    TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    void write(const std::string& name, std::string_view content) const;
    bool empty() const { return std::filesystem::is_empty(folder_); }

private:
    std::filesystem::path folder_;
};

/// Result of an import.
struct Imported
{
    Status status = success();
    std::vector<Error> warnings;
    SourceCounts counts;
    std::optional<SourceSky> sky;
    std::shared_ptr<TemporaryFolder> folder; ///< keeps the part's folder alive
    std::optional<formats::ContainerReader> part;

    bool ok() const { return status.ok(); }
    std::string message() const { return ok() ? "" : formatMessage(status.error()); }
    bool hasWarning(Issue issue, std::string_view text) const;

    mesh::SourceMesh mesh(uint32_t index = 0) const;
    std::string text(uint32_t chunk) const;

    template <typename T>
    std::vector<T> records(uint32_t chunk) const
    {
        auto read = part->records<T>(chunk);
        EXPECT_TRUE(read.ok());
        return std::vector<T>(read->begin(), read->end());
    }

    /// Return the RGBA8 texels of an image.
    std::vector<uint8_t> texels(uint32_t image) const;
};

/// Import bytes as the file `name` in a folder; by default the folder is empty.
Imported importBytes(std::string_view bytes, const TemporaryFolder* folder = nullptr,
                     const ImportOptions& options = {}, const std::string& name = "test.gltf");

/// Return a GLB of the document and the binary chunk.
std::string glb(std::string_view json, std::string_view binary);

/// Buffer of a document and the JSON that describes it: each add() makes one view and one accessor.
class GltfData
{
public:
    /// Add an accessor and return its index. `extra` is appended to its JSON: R"("normalized":true)".
    template <typename T>
    uint32_t add(const std::string& type, const std::vector<T>& values, const std::string& extra = "")
    {
        const uint32_t view = addView(
            std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
        return addAccessor(view, componentType<T>(), type, values.size() / components(type), extra);
    }

    uint32_t addView(std::string_view bytes, const std::string& extra = "");
    uint32_t addAccessor(std::optional<uint32_t> view, int component_type, const std::string& type,
                         size_t count, const std::string& extra = "");

    /// Return the whole document: asset, buffers, views and accessors, then `rest`, the other members.
    std::string json(const std::string& rest) const;
    const std::string& binary() const { return binary_; }

    Imported import(const std::string& rest, const TemporaryFolder* folder = nullptr,
                    const ImportOptions& options = {}) const
    {
        return importBytes(glb(json(rest), binary_), folder, options, "test.glb");
    }

private:
    template <typename T>
    static int componentType()
    {
        if constexpr (std::is_same_v<T, int8_t>)
            return 5120;
        else if constexpr (std::is_same_v<T, uint8_t>)
            return 5121;
        else if constexpr (std::is_same_v<T, int16_t>)
            return 5122;
        else if constexpr (std::is_same_v<T, uint16_t>)
            return 5123;
        else if constexpr (std::is_same_v<T, uint32_t>)
            return 5125;
        else
            return 5126;
    }
    static size_t components(const std::string& type);

    std::string binary_;
    std::string views_;
    std::string accessors_;
    uint32_t view_count_ = 0;
    uint32_t accessor_count_ = 0;
};

/// Return the bytes of plain values.
template <typename T>
std::string toBytes(const std::vector<T>& values)
{
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// Square in the plane z = 0, front side towards +z: four corners, and its two triangles.
inline const std::vector<float> kSquare{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
inline const std::vector<uint16_t> kSquareIndices{0, 1, 2, 0, 2, 3};

/// Return `text` with the only occurrence of `from` replaced; fails the test if there is none or several.
std::string replaced(std::string text, const std::string& from, const std::string& to);

} // namespace hearth::import::test
