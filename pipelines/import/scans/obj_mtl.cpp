// Parses material libraries.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/scans/obj_materials.h"
#include "pipelines/import/scans/text_cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hearth::import
{

namespace
{

using namespace std::string_view_literals;

/// Statements without a counterpart in the metallic-roughness material; illum only selects a shader.
constexpr std::array kIgnoredMaterialKeywords = {"illum"sv, "Ka"sv, "Ks"sv,       "Ni"sv,
                                                 "Tf"sv,    "Kt"sv, "sharpness"sv};

/// Option of a texture statement, with the minimum and maximum number of words after it.
struct TextureOption
{
    std::string_view name;
    int min_words;
    int max_words;
};
constexpr std::array kOptions = {
    TextureOption{"-blendu", 1, 1}, TextureOption{"-blendv", 1, 1},  TextureOption{"-cc", 1, 1},
    TextureOption{"-clamp", 1, 1},  TextureOption{"-imfchan", 1, 1}, TextureOption{"-texres", 1, 1},
    TextureOption{"-bm", 1, 1},     TextureOption{"-boost", 1, 1},   TextureOption{"-type", 1, 1},
    TextureOption{"-mm", 2, 2},     TextureOption{"-o", 1, 3},       TextureOption{"-s", 1, 3},
    TextureOption{"-t", 1, 3},
};

std::optional<float> parseNumber(std::string_view word)
{
    TextCursor text(word);
    const auto value = text.number();
    return value && text.atEnd() && std::isfinite(*value) ? std::optional(static_cast<float>(*value))
                                                          : std::nullopt;
}

class MtlReader
{
public:
    MtlReader(std::string_view text, const std::string& name, MtlLibrary& library)
        : text_(text), name_(name), library_(library)
    {
    }

    void read()
    {
        for (; !text_.atEnd(); text_.nextLine())
        {
            text_.skipBlanks();
            if (!text_.atLineEnd() && !text_.startsWith('#'))
                readStatement(text_.word());
        }
    }

private:
    void readStatement(std::string_view keyword)
    {
        if (keyword == "newmtl")
        {
            // the first of several materials with one name counts
            const auto [entry, added] = library_.materials.try_emplace(std::string(text_.restOfLine()));
            material_ = added ? &entry->second : &unused_;
            return;
        }
        if (material_ == nullptr)
            return;
        if (MtlTexture* texture = findTexture(keyword))
            readTexture(*texture);
        else if (keyword == "Kd")
            material_->has_diffuse = readColor(material_->diffuse);
        else if (keyword == "Ke")
            readColor(material_->emissive);
        else if (keyword == "d")
            readOpacity(false);
        else if (keyword == "Tr")
            readOpacity(true);
        else if (keyword == "Ns")
            material_->has_shininess = readScalar(material_->shininess);
        else if (std::find(kIgnoredMaterialKeywords.begin(), kIgnoredMaterialKeywords.end(), keyword) ==
                 kIgnoredMaterialKeywords.end())
            note(Issue::dropped, fmt::format("'{}' is not kept", keyword.substr(0, 40)));
    }

    void note(Issue issue, std::string detail)
    {
        constexpr size_t kMaxNotes = 20; // a library of 20 000 materials may repeat a note as often
        if (library_.notes.size() < kMaxNotes)
            library_.notes.push_back({issue, name_ + " " + text_.where(), std::move(detail)});
    }

    MtlTexture* findTexture(std::string_view keyword)
    {
        if (keyword == "map_Kd")
            return &material_->diffuse_map;
        if (keyword == "map_Ke")
            return &material_->emissive_map;
        if (keyword == "map_d")
            return &material_->opacity_map;
        const bool is_bump = keyword == "map_Bump" || keyword == "map_bump" || keyword == "bump";
        if (keyword == "norm" || keyword == "map_Kn" || (is_bump && material_->normal_map.file.empty()))
        {
            material_->normal_is_bump = is_bump;
            return &material_->normal_map;
        }
        return nullptr;
    }

    bool readScalar(float& value)
    {
        const auto number = parseNumber(text_.word());
        if (!number)
            note(Issue::repaired, "a number is missing; the default is used");
        else
            value = *number;
        return number.has_value();
    }

    bool readColor(Float3& color)
    {
        Float3 read;
        for (int c = 0; c < 3; ++c)
        {
            const auto number = parseNumber(text_.word());
            if (!number && c == 0)
            {
                note(Issue::repaired, "a colour is no three numbers; the default is used");
                return false;
            }
            read[c] = number ? std::max(*number, 0.0f) : read[c - 1]; // one number sets all three
        }
        color = read;
        return true;
    }

    void readOpacity(bool inverted)
    {
        TextCursor ahead = text_;
        if (ahead.word() == "-halo")
            text_ = ahead;
        float value = 1;
        if (!readScalar(value))
            return;
        value = std::clamp(inverted ? 1 - value : value, 0.0f, 1.0f);
        // many programs write "Tr 1" or "d 0" for opaque materials; nobody exports an invisible one
        if (value == 0)
            note(Issue::repaired, "a material that would be invisible is drawn opaque");
        material_->opacity = value == 0 ? 1 : value;
    }

    /// Read the options, the file name (which may have blanks), and with some writers options again.
    void readTexture(MtlTexture& texture)
    {
        texture = {};
        std::string file;
        for (text_.skipBlanks(); !text_.atLineEnd(); text_.skipBlanks())
        {
            TextCursor ahead = text_;
            const std::string_view word = ahead.word();
            const auto option = std::find_if(kOptions.begin(), kOptions.end(),
                                             [&](const TextureOption& o) { return o.name == word; });
            text_ = ahead;
            if (option != kOptions.end())
                readOption(*option, texture);
            else
                file.append(file.empty() ? "" : " ").append(word);
        }
        std::replace(file.begin(), file.end(), '\\', '/');
        texture.file = std::move(file);
    }

    void readOption(const TextureOption& option, MtlTexture& texture)
    {
        std::array<std::string_view, 3> words;
        std::array<float, 3> values{};
        for (int i = 0; i < option.max_words; ++i)
        {
            TextCursor ahead = text_;
            words[static_cast<size_t>(i)] = ahead.word();
            const auto value = parseNumber(words[static_cast<size_t>(i)]);
            if (i >= option.min_words && !value)
                break;
            values[static_cast<size_t>(i)] = value.value_or(0);
            text_ = ahead;
        }
        if (option.name == "-o")
            texture.offset = {values[0], values[1]};
        else if (option.name == "-s")
            texture.scale = {values[0], option.max_words > 1 && parseNumber(words[1]) ? values[1] : 1.0f};
        else if (option.name == "-clamp")
            texture.clamp = words[0] == "on";
        else if (option.name == "-bm")
            texture.bump_multiplier = values[0];
    }

    TextCursor text_;
    const std::string& name_;
    MtlLibrary& library_;
    MtlMaterial* material_ = nullptr;
    MtlMaterial unused_;
};

} // namespace

void readMtl(std::string_view text, const std::string& name, MtlLibrary& library)
{
    MtlReader(text, name, library).read();
}

float roughnessFromShininess(float shininess)
{
    // Blinn-Phong exponent n and width alpha of a microfacet lobe: alpha^2 = 2 / (n + 2) (B. Walter et al.,
    // "Microfacet Models for Refraction", 2007); glTF's roughness is the square root of alpha
    return std::sqrt(std::sqrt(2 / (std::max(shininess, 0.0f) + 2)));
}

} // namespace hearth::import
