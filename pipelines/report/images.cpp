// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/report/images.h"

#include "cook/json/json.h"
#include "cook/tools/child_processes.h"
#include "formats/base/regular_file.h"
#include "formats/base/temp_directory.h"
#include "formats/pack/pack_view.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <numeric>
#include <optional>
#include <set>

namespace hearth::report
{

namespace
{

using Clock = std::chrono::steady_clock;

// Meshes for each process. Starting a process and uploading the scene take seconds; the number is small
// enough to keep the time limit.
constexpr size_t kMeshesPerProcess = 12;

// Packs larger than this are streamed, so that their report needs no more memory than their cook did. Images
// are then taken before all pages have arrived, and may be coarser. Packs that are not streamed are drawn
// with a memory budget of 512 MiB, decoded: three times the geometry in the file of 84 million triangles.
constexpr uint64_t kLargePack = uint64_t{64} << 20;
constexpr const char* kMemoryBudget = "512M";

// Sizes of the scene's image, which fills half the width of a page, and of a contact sheet, whose cells
// shrink with the number of assets.
constexpr const char* kSceneSize = "480x270";
constexpr const char* kSheetSize = "960x540";

/// Read and remove a file.
std::optional<std::string> readAndRemove(const std::string& path)
{
    Result<std::string> content = readFile(path);
    if (!content.ok())
        return std::nullopt;
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    return std::move(content).value();
}

/// Draws images with hearth-render into a temporary folder.
class ImageRenderer
{
public:
    ImageRenderer(std::string pack, ImageProgress progress)
        : pack_(std::move(pack)), progress_(std::move(progress))
    {
    }

    bool prepare()
    {
        auto folder = TempDirectory::create(temporaryFolderOr(parentFolder(pack_)), pack_);
        if (!folder.ok())
            return false;
        folder_.emplace(std::move(folder).value());
        return true;
    }

    /// Set the number of expected images.
    void expect(size_t count)
    {
        count_ = count;
        reportProgress();
    }

    /// Draw each mesh, or the scene where there are none, in each view. Return nothing on failure; why() has
    /// the reason then.
    std::vector<std::vector<std::string>> draw(const std::vector<std::string>& views, const char* size,
                                               const std::vector<uint32_t>& meshes)
    {
        std::vector<std::string> command{tools::programFolder() + "/hearth-render",
                                         pack_,
                                         "-o",
                                         folder_->path() + "/image.jpg",
                                         "--size",
                                         size,
                                         "--samples",
                                         "4",
                                         "--gi",
                                         "off",
                                         "--views",
                                         fmt::format("{}", fmt::join(views, ","))};
        std::error_code error;
        if (std::filesystem::file_size(pack_, error) > kLargePack)
            command.insert(command.end(), {"--budget", kMemoryBudget});
        const std::string statistics = folder_->path() + "/image.json";
        if (meshes.empty())
            command.insert(command.end(), {"--stats", statistics});
        else
            command.insert(command.end(), {"--meshes", fmt::format("{}", fmt::join(meshes, ","))});
        if (!run(command))
            return {};
        if (meshes.empty())
        {
            const Json frame = Json::parse(readAndRemove(statistics).value_or("")).value_or(Json());
            has_drawn_sheet_ = frame.is_object() && frame.contains("sheet");
        }
        std::vector<std::vector<std::string>> images(std::max<size_t>(meshes.size(), 1));
        for (size_t i = 0; i < images.size(); ++i)
            for (const std::string& view : views)
            {
                const std::string number = meshes.empty() ? "" : fmt::format("-{:04}", i);
                const auto file =
                    readAndRemove(fmt::format("{}/image-{}{}.jpg", folder_->path(), view, number));
                if (!file)
                    return {};
                images[i].push_back(*file);
                ++taken_;
            }
        reportProgress();
        return images;
    }

    const std::string& why() const { return why_; }
    /// True if hearth-render drew a contact sheet of the scene.
    bool hasDrawnSheet() const { return has_drawn_sheet_; }

private:
    /// Report progress; files in the folder count as drawn.
    void reportProgress() const
    {
        if (!progress_)
            return;
        std::error_code error;
        size_t files = 0;
        for (auto file = std::filesystem::directory_iterator(folder_->path(), error);
             !error && file != std::filesystem::directory_iterator(); file.increment(error))
            ++files;
        progress_(std::min(taken_ + files, count_), count_);
    }

    bool run(const std::vector<std::string>& command)
    {
        tools::ChildProcesses children;
        if (!children.start(command).ok())
        {
            why_ = "hearth-render cannot be started";
            return false;
        }
        const auto end = children.wait([this] { reportProgress(); });
        if (!end)
        {
            why_ = "interrupted";
            return false;
        }
        if (end->signal == 0 && end->exit_code == 0)
            return true;
        why_ = end->messages.substr(0, end->messages.find('\n'));
        return false;
    }

    std::string pack_;
    ImageProgress progress_;
    size_t count_ = 0;
    size_t taken_ = 0; ///< images taken out of the folder
    std::optional<TempDirectory> folder_;
    std::string why_;
    bool has_drawn_sheet_ = false;
};

Result<formats::PackView> openPack(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerReader reader,
                            formats::ContainerReader::open(path, formats::Check::structure));
    return formats::PackView::read(std::move(reader));
}

/// Return the meshes of the list that the pack has and draws somewhere.
std::vector<uint32_t> selectDrawable(const formats::PackView& pack, const std::vector<PackMesh>& meshes)
{
    std::set<uint32_t> drawn;
    for (const formats::InstanceRecord& instance : pack.instances())
        drawn.insert(instance.mesh);
    std::vector<uint32_t> indices;
    for (const PackMesh& mesh : meshes)
        if (drawn.contains(mesh.index) && mesh.index < pack.meshes().size() &&
            pack.meshes()[mesh.index].clusters.count > 0 &&
            pack.text(pack.meshes()[mesh.index].name) == mesh.name)
            indices.push_back(mesh.index);
    return indices;
}

bool hasVisibility(const formats::PackView& pack)
{
    return std::any_of(pack.meshes().begin(), pack.meshes().end(),
                       [](const formats::MeshRecord& mesh)
                       { return (mesh.attributes & formats::kVertexVisibility) != 0; });
}

uint64_t totalBytes(const Images& images)
{
    const auto sum = [](const std::vector<std::string>& files)
    {
        return std::accumulate(files.begin(), files.end(), uint64_t{0},
                               [](uint64_t bytes, const std::string& file) { return bytes + file.size(); });
    };
    uint64_t bytes = sum(images.scene);
    for (const auto& [mesh, files] : images.meshes)
        bytes += sum(files);
    return bytes;
}

} // namespace

Images renderImages(const std::string& pack_path, const std::vector<PackMesh>& meshes,
                    const ImageProgress& progress, const ImageLimits& limits)
{
    Images images;
    images.left_out = meshes.size();
    const auto reader = openPack(pack_path);
    ImageRenderer renderer(pack_path, progress);
    if (!reader.ok() || !renderer.prepare())
    {
        images.why_left_out = reader.ok() ? "there is no folder for them" : formatMessage(reader.error());
        return images;
    }
    const Clock::time_point start = Clock::now();
    const auto isLate = [&]
    { return std::chrono::duration<double>(Clock::now() - start).count() > limits.seconds; };
    images.views = {"final", "clusters", "lod"};
    if (hasVisibility(*reader))
        images.views.emplace_back("ao");
    const std::vector<uint32_t> drawn = selectDrawable(*reader, meshes);
    const size_t count = std::min(drawn.size(), limits.meshes);
    renderer.expect((1 + count) * images.views.size());
    auto scene = renderer.draw(images.views, kSceneSize, {});
    if (renderer.hasDrawnSheet())
        scene = renderer.draw(images.views, kSheetSize, {});
    if (scene.empty())
    {
        // a device that cannot draw the scene cannot draw its meshes
        images.why_left_out = renderer.why();
        return images;
    }
    images.scene = scene.front();
    images.is_sheet = renderer.hasDrawnSheet();
    for (size_t first = 0; first < count && !isLate() && totalBytes(images) < limits.bytes;
         first += kMeshesPerProcess)
    {
        const auto begin = drawn.begin() + static_cast<std::ptrdiff_t>(first);
        const std::vector<uint32_t> some(
            begin, begin + static_cast<std::ptrdiff_t>(std::min(kMeshesPerProcess, count - first)));
        const auto files = renderer.draw(images.views, "240x180", some);
        for (size_t i = 0; i < files.size(); ++i)
            images.meshes[some[i]] = files[i];
    }
    images.left_out = meshes.size() - images.meshes.size();
    if (images.left_out > 0)
        images.why_left_out = images.meshes.size() < count
                                  ? "drawing took too long, or too many bytes"
                                  : "the largest of each asset, and then the largest, have one";
    return images;
}

} // namespace hearth::report
