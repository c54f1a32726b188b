// Converts the materials of a scan to materials of the part: libraries and images come from the asset's
// folder.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/scans/obj_materials.h"

#include "pipelines/import/images/channels.h"
#include "pipelines/import/images/decode.h"
#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"
#include "pipelines/import/source/file_bytes.h"

#include "pipelines/import/images/placeholder.h"
#include "pipelines/import/source/asset_folder.h"

#include <algorithm>
#include <cstring>

namespace hearth::import
{

namespace
{

constexpr float kAlphaCutoff = 0.5f;
// Roughness of a surface with unspecified gloss, such as clay or plaster: scans carry light and shade in
// their colours.
constexpr float kDefaultRoughness = 0.8f;

enum class Purpose : uint32_t
{
    color,
    normals,
};

class ScanMaterials
{
public:
    ScanMaterials(const ScanPolygons& scan, const std::string& path, const ImportOptions& options,
                  PartBuilder& part)
        : scan_(scan), options_(options), part_(part), folder_(path, options.reads)
    {
    }

    Result<ScanMaterialIndices> add()
    {
        for (const std::string& library : scan_.material_libraries)
            readLibraries(library);
        for (const ScanNote& note : library_.notes)
            part_.warn(note.issue, note.where, note.detail);

        ScanMaterialIndices indices;
        for (const std::string& name : scan_.material_names)
        {
            material_ = name;
            const auto found = library_.materials.find(name);
            if (found == library_.materials.end())
                ++undefined_;
            HEARTH_ASSIGN_OR_RETURN(
                const formats::MaterialRecord record,
                convertMaterial(found == library_.materials.end() ? MtlMaterial{} : found->second));
            indices.by_name.push_back(static_cast<uint32_t>(part_.materials.size()));
            part_.materials.push_back(record);
            part_.materials.back().name = part_.intern(name);
        }
        if (undefined_ > 0)
            part_.warn(Issue::degraded, "",
                       std::to_string(undefined_) +
                           " materials are not in the material libraries and are drawn grey");
        material_.clear();
        indices.fallback = defaultScanMaterial();
        if (!scan_.texture_file.empty() && !scan_.uvs.empty())
        {
            MtlMaterial textured;
            textured.diffuse_map.file = scan_.texture_file;
            HEARTH_TRY(addBaseColor(textured, indices.fallback));
        }
        return indices;
    }

private:
    /// Read the libraries of a mtllib statement: one name that may have blanks, else several names.
    void readLibraries(const std::string& names)
    {
        if (readLibrary(names))
            return;
        bool all = names.find(' ') != std::string::npos;
        for (size_t at = 0; all && at < names.size();)
        {
            const size_t end = std::min(names.find(' ', at), names.size());
            all = end == at || readLibrary(names.substr(at, end - at));
            at = end + 1;
        }
        if (!all)
            part_.warn(Issue::material_missing, "",
                       "material library '" + names + "' beside " + folder_.assetName() + ": " + failure_,
                       suggestion_);
    }

    bool readLibrary(std::string name)
    {
        std::replace(name.begin(), name.end(), '\\', '/');
        if (std::find(libraries_read_.begin(), libraries_read_.end(), name) != libraries_read_.end())
            return true;
        const auto file = folder_.read(name, options_.limits.max_file_bytes);
        if (!file)
        {
            failure_ = file.error().detail;
            suggestion_ = folder_.suggestNearest(name, file.error().issue);
            return false;
        }
        libraries_read_.push_back(name);
        const std::span<const std::byte> bytes = file->bytes();
        part_.addSource(name, bytes);
        readMtl({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name, library_);
        return true;
    }

    Result<formats::MaterialRecord> convertMaterial(const MtlMaterial& mtl)
    {
        formats::MaterialRecord record = defaultScanMaterial();
        const bool has_map = !mtl.diffuse_map.file.empty();
        // programs write Kd 0 beside a map, or no Kd: then the map alone counts
        const bool black = mtl.diffuse.x == 0 && mtl.diffuse.y == 0 && mtl.diffuse.z == 0;
        const Float3 diffuse = has_map && (black || !mtl.has_diffuse) ? Float3{1, 1, 1} : mtl.diffuse;
        record.base_color = {diffuse.x, diffuse.y, diffuse.z, mtl.opacity};
        record.emissive = mtl.emissive;
        if (mtl.has_shininess)
            record.roughness = roughnessFromShininess(mtl.shininess);
        if (mtl.opacity < 1)
            record.alpha_mode = static_cast<uint32_t>(formats::AlphaMode::blend);
        HEARTH_TRY(addBaseColor(mtl, record));
        HEARTH_TRY(addEmissive(mtl, record));
        HEARTH_TRY(addNormals(mtl, record));
        return record;
    }

    Status addBaseColor(const MtlMaterial& mtl, formats::MaterialRecord& record)
    {
        const bool has_opacity = !mtl.opacity_map.file.empty();
        if (mtl.diffuse_map.file.empty() && !has_opacity)
            return success();
        const MtlTexture& placement = mtl.diffuse_map.file.empty() ? mtl.opacity_map : mtl.diffuse_map;
        const std::string key = "color\n" + mtl.diffuse_map.file + "\n" + mtl.opacity_map.file;
        if (has_opacity)
            record.alpha_mode = static_cast<uint32_t>(formats::AlphaMode::mask);
        const auto known = image_of_key_.find(key);
        if (known != image_of_key_.end())
        {
            setTexture(record.base_color_texture, placement, known->second);
            return success();
        }
        bool placeholder = false;
        DecodedImage image = has_opacity && mtl.diffuse_map.file.empty()
                                 ? DecodedImage{}
                                 : load(mtl.diffuse_map.file, true, placeholder);
        if (has_opacity)
            mergeOpacity(mtl, image);
        const uint32_t flags =
            (placeholder ? formats::kImagePlaceholder : 0u) | (has_opacity ? formats::kImageAlphaTested : 0u);
        HEARTH_ASSIGN_OR_RETURN(const uint32_t index, addImage(placement.file, image, Purpose::color, flags));
        image_of_key_.emplace(key, index);
        setTexture(record.base_color_texture, placement, index);
        return success();
    }

    Status addEmissive(const MtlMaterial& mtl, formats::MaterialRecord& record)
    {
        if (mtl.emissive_map.file.empty())
            return success();
        HEARTH_ASSIGN_OR_RETURN(const uint32_t image, textureImage(mtl.emissive_map, Purpose::color, false));
        const bool black = mtl.emissive.x == 0 && mtl.emissive.y == 0 && mtl.emissive.z == 0;
        record.emissive = black ? Float3{1, 1, 1} : mtl.emissive;
        setTexture(record.emissive_texture, mtl.emissive_map, image);
        return success();
    }

    Status addNormals(const MtlMaterial& mtl, formats::MaterialRecord& record)
    {
        if (mtl.normal_map.file.empty())
            return success();
        HEARTH_ASSIGN_OR_RETURN(const uint32_t image,
                                textureImage(mtl.normal_map, Purpose::normals, mtl.normal_is_bump));
        record.normal_scale = mtl.normal_map.bump_multiplier;
        setTexture(record.normal_texture, mtl.normal_map, image);
        return success();
    }

    /// Return the image of a texture, or none if the surface looks better without one.
    Result<uint32_t> textureImage(const MtlTexture& texture, Purpose purpose, bool may_be_height_map)
    {
        const std::string key = (purpose == Purpose::color ? "color\n" : "normals\n") + texture.file + "\n";
        const auto known = image_of_key_.find(key);
        if (known != image_of_key_.end())
            return known->second;
        bool placeholder = false;
        DecodedImage image = load(texture.file, purpose == Purpose::color, placeholder);
        // the flat normal is (128, 128, 255)
        const bool height_map = may_be_height_map && !placeholder && !image.isFloat() && isGrey(image);
        if (height_map)
            part_.warn(Issue::dropped, "", "height map '" + texture.file + "' is not kept (normal maps are)");
        // a placeholder holds no normals
        uint32_t index = kInvalidIndex;
        if (!height_map && (!placeholder || purpose != Purpose::normals))
        {
            if (purpose == Purpose::normals)
                image = completeNormals(std::move(image));
            HEARTH_ASSIGN_OR_RETURN(
                index, addImage(texture.file, image, purpose, placeholder ? formats::kImagePlaceholder : 0u));
        }
        image_of_key_.emplace(key, index);
        return index;
    }

    Result<uint32_t> addImage(const std::string& name, const DecodedImage& image, Purpose purpose,
                              uint32_t flags)
    {
        formats::ImageRecord record{};
        record.name = part_.intern(name);
        const auto format =
            purpose == Purpose::color ? formats::TexelFormat::rgba8_srgb : formats::TexelFormat::rgba8_unorm;
        if (purpose == Purpose::color)
            part_.warnOfColorDepth(image, "", "image '" + name + "'" + describeUser());
        record.format = static_cast<uint32_t>(format);
        record.flags = flags | (purpose == Purpose::normals ? formats::kImageNormalMap : 0u);
        record.alpha_cutoff = (flags & formats::kImageAlphaTested) != 0 ? kAlphaCutoff : 0;
        return part_.addImage(record, image);
    }

    static void setTexture(formats::TextureRef& ref, const MtlTexture& texture, uint32_t image)
    {
        const auto wrap =
            static_cast<uint8_t>(texture.clamp ? formats::Wrap::clamp_to_edge : formats::Wrap::repeat);
        ref.image = image;
        ref.wrap_u = ref.wrap_v = wrap;
        // v counts from the top here: 1 - ((1 - v) * s + o) = v * s + 1 - s - o
        const float transform[6] = {
            texture.scale.x, 0, texture.offset.x, 0, texture.scale.y, 1 - texture.scale.y - texture.offset.y};
        std::memcpy(ref.uv_transform, transform, sizeof(transform));
    }

    /// are_colors  false: numbers, which no ICC profile may change
    Result<DecodedImage> read(const std::string& name, bool are_colors)
    {
        HEARTH_ASSIGN_OR_RETURN(const FileBytes file, folder_.read(name, options_.limits.max_file_bytes));
        part_.addSource(name, file.bytes());
        Result<DecodedImage> image = decodeImage(file.bytes(), name, options_.limits,
                                                 are_colors ? options_.artist : options_.artist.withoutIcc());
        if (!image.ok())
            return image;
        const std::string described = "image '" + name + "'" + describeUser();
        for (const ImageNote& note : image->notes)
            part_.warn(note.issue, "", described + ": " + note.text);
        part_.warnOfTransfer(*image, are_colors, "", described);
        return image;
    }

    /// Load an image, or return the placeholder with a warning.
    DecodedImage load(const std::string& file, bool are_colors, bool& placeholder)
    {
        auto image = read(file, are_colors);
        placeholder = !image.ok();
        if (image.ok())
            return std::move(image).value();
        warnOfImage(file, image.error());
        return makePlaceholderImage();
    }

    /// Return the material that is being made, for a message about its images.
    std::string describeUser() const { return material_.empty() ? "" : " of material '" + material_ + "'"; }

    void warnOfImage(const std::string& file, const Error& error)
    {
        const bool missing = error.issue == Issue::input_missing;
        part_.warn(missing ? Issue::image_missing : Issue::image_replaced, "",
                   "image '" + file + "'" + describeUser() + " beside " + folder_.assetName() + ": " +
                       error.detail,
                   folder_.suggestNearest(file, error.issue));
    }

    /// Put the opacity map into the alpha of `image` (a white image if there is none): the map's alpha if it
    /// has transparent texels, else its brightness.
    void mergeOpacity(const MtlMaterial& mtl, DecodedImage& image)
    {
        auto opacity = read(mtl.opacity_map.file, false);
        if (!opacity.ok() || opacity->isFloat() || image.isFloat())
        {
            warnOfImage(mtl.opacity_map.file, opacity.ok()
                                                  ? Error{Issue::image_replaced, "", "", "floating point"}
                                                  : opacity.error());
            if (image.texels.empty())
                image = makePlaceholderImage();
            return;
        }
        if (image.texels.empty())
        {
            image = {opacity->width, opacity->height, opacity->type, {}};
            image.texels.assign(opacity->texels.size(), std::byte{0xFF});
        }
        if (image.type != opacity->type)
        {
            image = widen(std::move(image));
            opacity = widen(std::move(opacity).value());
        }
        const size_t bytes = image.channelBytes();
        const size_t channel = hasAlpha(*opacity) ? 3 : 0;
        for (size_t y = 0; y < image.height; ++y)
            for (size_t x = 0; x < image.width; ++x)
            {
                const size_t from =
                    (y * opacity->height / image.height) * opacity->width + x * opacity->width / image.width;
                std::memcpy(image.texels.data() + ((y * image.width + x) * 4 + 3) * bytes,
                            opacity->texels.data() + (from * 4 + channel) * bytes, bytes);
            }
    }

    const ScanPolygons& scan_;
    const ImportOptions& options_;
    PartBuilder& part_;
    AssetFolder folder_;
    MtlLibrary library_;
    std::vector<std::string> libraries_read_;
    std::string failure_;
    std::string suggestion_;
    std::string material_; ///< name of the material being made; empty: for faces without a material
    std::map<std::string, uint32_t> image_of_key_;
    size_t undefined_ = 0;
};

} // namespace

formats::MaterialRecord defaultScanMaterial()
{
    formats::MaterialRecord record{};
    record.base_color = {1, 1, 1, 1};
    record.alpha_cutoff = kAlphaCutoff;
    record.roughness = kDefaultRoughness;
    record.normal_scale = 1;
    record.occlusion_strength = 1;
    for (formats::TextureRef* ref :
         {&record.base_color_texture, &record.metallic_roughness_texture, &record.normal_texture,
          &record.occlusion_texture, &record.emissive_texture})
    {
        ref->image = kInvalidIndex;
        ref->uv_transform[0] = ref->uv_transform[4] = 1;
    }
    return record;
}

Result<ScanMaterialIndices> addScanMaterials(const ScanPolygons& scan, const std::string& path,
                                             const ImportOptions& options, PartBuilder& part)
{
    return ScanMaterials(scan, path, options, part).add();
}

} // namespace hearth::import
