// Writes the images of a textures part, and the materials if they change.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/textures/roughness_uses.h"
#include "cook/textures/texture_part.h"
#include "formats/container/container_reader.h"
#include "formats/container/container_writer.h"
#include "formats/records/material_layers.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::textures
{

/// Return a name; empty if it is not in the table.
std::string readName(std::string_view strings, const formats::StringRef& name);

/// Images of an import part and the materials that shall use them. Must outlive the writer.
struct PartTables
{
    std::span<const formats::ImageRecord> images{};
    std::vector<bool> is_kept{};        ///< [image]: written; no material may use one that is not
    std::span<const uint32_t> joined{}; ///< [image]: as listJoinedOcclusion()
    std::span<const formats::MaterialRecord> materials{};
    std::span<const formats::MaterialLayersRecord> layers{};
    std::string_view strings{};
};

/// Textures part being written. Images of the import part keep their order, and new ones follow, called after
/// the image that they are made of. Materials and their layers are written if they differ from those of the
/// import part.
class PartWriter
{
public:
    /// has_statistics  statistics of each image are computed
    PartWriter(const formats::ContainerReader& part, const PartTables& tables, const TextureOptions& options,
               bool has_statistics, formats::ContainerWriter& writer);

    /// Write the mips of an image of the import part if it is kept, and one for each further use that needs
    /// another roughness.
    /// uses         of the image as roughness, empty: none
    /// fills_alpha  its colours under an alpha of 0 are filled
    Status writeImage(uint32_t source, std::span<const RoughnessUse> uses, bool fills_alpha);

    /// Write an image for materials that have none, if their roughness rises.
    Status writeMissingRoughness(const RoughnessUse& use);

    /// Write the tables.
    Status finish();

    std::span<const formats::MaterialRecord> materials() const { return materials_; }
    std::span<const formats::MaterialLayersRecord> layers() const { return layers_; }
    std::string_view strings() const { return strings_; }
    std::vector<ImageStatistics>& statistics() { return statistics_; }

private:
    void numberImages();
    Result<std::vector<std::byte>> readJoined(uint32_t source);
    Result<std::vector<std::byte>> buildMips(const RoughnessUse& use, const formats::ImageRecord& image,
                                             std::vector<std::byte> texels);
    Status writeVariants(uint32_t index, std::span<const RoughnessUse> uses,
                         const formats::ImageRecord& image, const std::vector<std::byte>& texels,
                         const std::vector<std::byte>& chain);
    Status writeChain(uint32_t index, formats::ImageRecord image, std::span<const std::byte> chain,
                      std::span<const std::byte> imported);
    uint32_t addImage();
    formats::StringRef addName(const formats::StringRef& source, uint32_t number);
    void useImage(const RoughnessUse& use, uint32_t image);

    const formats::ContainerReader& part_;
    const PartTables& tables_;
    std::vector<formats::MaterialRecord> materials_;
    std::vector<formats::MaterialLayersRecord> layers_;
    const TextureOptions& options_;
    formats::ContainerWriter& writer_;
    std::vector<uint32_t> numbers_{}; ///< [image of the import part]: that of the part, kInvalidIndex: none
    std::vector<formats::ImageRecord> records_{};
    std::string strings_; ///< of the import part, then names of images that are made here
    std::vector<ImageStatistics> statistics_{};  ///< of each record, if they are wanted
    std::map<uint32_t, uint32_t> made_images_{}; ///< [normal map]: roughness images that are made of it
    bool has_statistics_;
    bool has_changed_materials_ = false;
};

} // namespace hearth::textures
