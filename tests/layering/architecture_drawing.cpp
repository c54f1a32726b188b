// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/layering/architecture_drawing.h"

#include "formats/base/assert.h"
#include "tests/layering/layers.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <vector>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

constexpr int kBoxWidth = 172, kBoxHeight = 30, kColumnGap = 14, kFloorGap = 46, kMargin = 16;

/// "cook/clusters" of "cook/clusters/core/bounds.cpp"; "sample_assets" of a folder that is drawn as one.
std::string drawnFolder(std::string_view file)
{
    const std::string_view folder = getFolder(file);
    if (folder.starts_with("sample_assets"))
        return "sample_assets";
    return std::string(folder.substr(0, folder.find('/', folder.find('/') + 1)));
}

struct Box
{
    std::string folder;
    int floor = 0;
    double column = 0; ///< order within its floor
};

using Floors = std::map<std::string, int>;

int findFloor(const FolderGraph& graph, const std::string& folder, Floors& floors, int depth)
{
    HEARTH_ASSERT(depth <= static_cast<int>(graph.size()));
    if (const auto found = floors.find(folder); found != floors.end())
        return found->second;
    int floor = 0;
    if (const auto arrows = graph.find(folder); arrows != graph.end())
        for (const std::string& to : arrows->second)
            floor = std::max(floor, findFloor(graph, to, floors, depth + 1) + 1);
    return floors[folder] = floor;
}

bool reaches(const FolderGraph& graph, const std::string& from, const std::string& to)
{
    const auto arrows = graph.find(from);
    return arrows != graph.end() &&
           std::any_of(arrows->second.begin(), arrows->second.end(),
                       [&](const std::string& next) { return next == to || reaches(graph, next, to); });
}

/// The graph without arrows that follow from others.
FolderGraph reduce(const FolderGraph& graph)
{
    FolderGraph reduced;
    for (const auto& [from, targets] : graph)
        for (const std::string& to : targets)
            if (std::none_of(targets.begin(), targets.end(),
                             [&](const std::string& other)
                             { return other != to && reaches(graph, other, to); }))
                reduced[from].insert(to);
    return reduced;
}

/// Order the boxes of each floor by the mean position of their neighbours, so that arrows cross rarely.
void orderColumns(const FolderGraph& graph, std::vector<std::vector<Box>>& floors)
{
    std::map<std::string, double> place;
    const auto number = [&](std::vector<Box>& floor)
    {
        for (size_t i = 0; i < floor.size(); ++i)
            place[floor[i].folder] = (static_cast<double>(i) + 0.5) / static_cast<double>(floor.size());
    };
    for (auto& floor : floors)
        number(floor);
    for (int sweep = 0; sweep < 8; ++sweep)
        for (auto& floor : floors)
        {
            for (Box& box : floor)
            {
                double sum = place[box.folder];
                int count = 1;
                for (const auto& [from, targets] : graph)
                    for (const std::string& to : targets)
                        if (from == box.folder || to == box.folder)
                        {
                            sum += place[from == box.folder ? to : from];
                            ++count;
                        }
                box.column = sum / count;
            }
            std::stable_sort(floor.begin(), floor.end(),
                             [](const Box& a, const Box& b) { return a.column < b.column; });
            number(floor);
        }
}

const char* chooseColor(std::string_view folder)
{
    return folder.starts_with("formats")     ? "#d8e6f3"
           : folder.starts_with("cook")      ? "#f6e3c5"
           : folder.starts_with("pipelines") ? "#dcebd5"
           : folder.starts_with("runtime")   ? "#efd6d6"
                                             : "#e6e6e6";
}

} // namespace

FolderGraph readFolderGraph(const std::string& root)
{
    FolderGraph graph;
    for (const char* top : {"formats", "cook", "pipelines", "runtime", "sample_assets"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(root) / top))
        {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cpp")
                continue;
            const std::string file = entry.path().lexically_relative(root).generic_string();
            const std::string from = drawnFolder(file);
            if (from.find('/') == std::string::npos && from != "sample_assets")
                continue;
            graph[from];
            std::ifstream stream(entry.path(), std::ios::binary);
            const std::string text{std::istreambuf_iterator<char>(stream), {}};
            for (const Include& include : findIncludes(text))
                if (const std::string to = drawnFolder(include.header);
                    !include.angled && include.header.find('/') != std::string::npos && to != from)
                    graph[from].insert(to);
        }
    return graph;
}

std::string drawFolderGraph(const FolderGraph& graph)
{
    const FolderGraph arrows = reduce(graph);
    Floors floor_of_folder;
    int top = 0;
    for (const auto& [folder, targets] : graph)
        top = std::max(top, findFloor(graph, folder, floor_of_folder, 0));
    std::vector<std::vector<Box>> floors(static_cast<size_t>(top) + 1);
    for (const auto& [folder, floor] : floor_of_folder)
        floors[static_cast<size_t>(floor)].push_back({folder, floor, 0});
    orderColumns(arrows, floors);

    size_t widest = 0;
    for (const auto& floor : floors)
        widest = std::max(widest, floor.size());
    const int width = static_cast<int>(widest) * (kBoxWidth + kColumnGap) - kColumnGap + 2 * kMargin;
    const int height = (top + 1) * (kBoxHeight + kFloorGap) - kFloorGap + 2 * kMargin;

    std::map<std::string, std::pair<double, double>> corner; // upper left
    for (const auto& floor : floors)
        for (size_t i = 0; i < floor.size(); ++i)
        {
            const double pitch = static_cast<double>(width - 2 * kMargin) / static_cast<double>(floor.size());
            corner[floor[i].folder] = {kMargin + (static_cast<double>(i) + 0.5) * pitch - kBoxWidth / 2.0,
                                       kMargin + (top - floor[i].floor) * (kBoxHeight + kFloorGap)};
        }

    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
        width, height);
    for (const auto& [from, targets] : arrows)
        for (const std::string& to : targets)
        {
            const auto [x0, y0] = corner[from];
            const auto [x1, y1] = corner[to];
            const double ax = x0 + kBoxWidth / 2.0, ay = y0 + kBoxHeight, bx = x1 + kBoxWidth / 2.0, by = y1;
            svg +=
                fmt::format("<path d=\"M{:.0f} {:.0f}C{:.0f} {:.0f} {:.0f} {:.0f} {:.0f} {:.0f}\" "
                            "fill=\"none\" stroke=\"#888\"/>\n<circle cx=\"{:.0f}\" cy=\"{:.0f}\" r=\"2.5\" "
                            "fill=\"#555\"/>\n",
                            ax, ay, ax, ay + kFloorGap / 2.0, bx, by - kFloorGap / 2.0, bx, by, bx, by);
        }
    for (const auto& [folder, at] : corner)
        svg += fmt::format(
            "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{}\" height=\"{}\" rx=\"5\" fill=\"{}\" "
            "stroke=\"#666\"/>\n<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>\n",
            at.first, at.second, kBoxWidth, kBoxHeight, chooseColor(folder), at.first + kBoxWidth / 2.0,
            at.second + 19, folder);
    return svg + "</svg>\n";
}

} // namespace hearth::test
