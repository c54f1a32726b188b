// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines/gltf_fixture.h"

#include "pipelines/import/gltf/import_gltf.h"
#include "pipelines/import/source/file_bytes.h"

#include <algorithm>
#include <cstdlib>

namespace hearth::import::test
{

TemporaryFolder::TemporaryFolder()
{
    std::string pattern = (std::filesystem::temp_directory_path() / "hearth-test-XXXXXX").string();
    const char* made = ::mkdtemp(pattern.data());
    EXPECT_NE(made, nullptr);
    folder_ = pattern;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

void TemporaryFolder::write(const std::string& name, std::string_view content) const
{
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << content;
}

bool Imported::hasWarning(Issue issue, std::string_view text) const
{
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const Error& warning)
                       { return warning.issue == issue && warning.detail.find(text) != std::string::npos; });
}

mesh::SourceMesh Imported::mesh(uint32_t index) const
{
    auto read = mesh::readSourceMesh(*part, index);
    EXPECT_TRUE(read.ok());
    return read.ok() ? *read : mesh::SourceMesh{};
}

std::string Imported::text(uint32_t chunk) const
{
    auto read = part->read(chunk);
    EXPECT_TRUE(read.ok());
    return {reinterpret_cast<const char*>(read->bytes().data()), read->bytes().size()};
}

std::vector<uint8_t> Imported::texels(uint32_t image) const
{
    auto read = part->read(formats::kChunkImageData, image);
    EXPECT_TRUE(read.ok());
    std::vector<uint8_t> texels;
    for (const std::byte value : read->bytes())
        texels.push_back(static_cast<uint8_t>(value));
    return texels;
}

Imported importBytes(std::string_view bytes, const TemporaryFolder* folder, const ImportOptions& options,
                     const std::string& name)
{
    Imported result;
    result.folder = std::make_shared<TemporaryFolder>();
    const std::string output = result.folder->path("out.part");
    auto part = PartBuilder::create(output, name);
    EXPECT_TRUE(part.ok());
    const TemporaryFolder none;
    const std::string path = (folder != nullptr ? *folder : none).path(name);
    std::ofstream(path, std::ios::binary) << bytes;
    const auto content = std::as_bytes(std::span(bytes));
    result.status = importGltf(path, FileBytes({content.begin(), content.end()}), options, *part);
    result.warnings = part->warnings();
    result.counts = part->counts;
    result.sky = part->sky;
    if (!result.ok())
        return result;
    EXPECT_TRUE(part->finish().ok());
    auto reader = formats::ContainerReader::open(output);
    EXPECT_TRUE(reader.ok());
    if (reader.ok())
        result.part = std::move(*reader);
    return result;
}

std::string glb(std::string_view json, std::string_view binary)
{
    const auto number = [](size_t value)
    {
        const auto narrow = static_cast<uint32_t>(value);
        return std::string(reinterpret_cast<const char*>(&narrow), sizeof(narrow));
    };
    const std::string padded_json = std::string(json) + std::string((4 - json.size() % 4) % 4, ' ');
    const std::string padded_binary = std::string(binary) + std::string((4 - binary.size() % 4) % 4, '\0');
    std::string chunks = number(padded_json.size()) + "JSON" + padded_json;
    if (!binary.empty())
        chunks += number(padded_binary.size()) + std::string("BIN\0", 4) + padded_binary;
    return "glTF" + number(2) + number(12 + chunks.size()) + chunks;
}

size_t GltfData::components(const std::string& type)
{
    return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
}

uint32_t GltfData::addView(std::string_view bytes, const std::string& extra)
{
    binary_.resize((binary_.size() + 3) / 4 * 4);
    views_ += (views_.empty() ? "" : ",") + std::string(R"({"buffer":0,"byteOffset":)") +
              std::to_string(binary_.size()) + R"(,"byteLength":)" + std::to_string(bytes.size()) +
              (extra.empty() ? "" : "," + extra) + "}";
    binary_ += bytes;
    return view_count_++;
}

uint32_t GltfData::addAccessor(std::optional<uint32_t> view, int component_type, const std::string& type,
                               size_t count, const std::string& extra)
{
    accessors_ += (accessors_.empty() ? "" : ",") + std::string(R"({"componentType":)") +
                  std::to_string(component_type) + R"(,"type":")" + type + R"(","count":)" +
                  std::to_string(count) + (view ? R"(,"bufferView":)" + std::to_string(*view) : "") +
                  (extra.empty() ? "" : "," + extra) + "}";
    return accessor_count_++;
}

std::string GltfData::json(const std::string& rest) const
{
    std::string text = R"({"asset":{"version":"2.0"})";
    if (!binary_.empty())
        text += R"(,"buffers":[{"byteLength":)" + std::to_string(binary_.size()) + "}]";
    if (!views_.empty())
        text += R"(,"bufferViews":[)" + views_ + "]";
    if (!accessors_.empty())
        text += R"(,"accessors":[)" + accessors_ + "]";
    return text + (rest.empty() ? "" : "," + rest) + "}";
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    EXPECT_EQ(text.find(from, at + 1), std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

} // namespace hearth::import::test
