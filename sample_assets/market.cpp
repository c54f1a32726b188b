// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/market.h"

#include "formats/base/assert.h"
#include "sample_assets/market/evening.h"
#include "sample_assets/market/goods.h"
#include "sample_assets/market/lights.h"
#include "sample_assets/market/stalls.h"
#include "sample_assets/market/street.h"
#include "sample_assets/market/surroundings.h"
#include "sample_assets/people/market_people.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/sky.h"

namespace hearth::samples
{

namespace
{

void addCameras(Document& document)
{
    addCamera(document, {.name = "street", .y_fov_rad = 0.80f}, {0.55f, 1.62f, 27.6f}, {-0.25f, 1.9f, 8});
    addCamera(document, {.name = "above", .y_fov_rad = 0.80f}, {4, 23, 50}, {0.5f, 0, 3});
    // looks down on the two characters; samples_market_test counts the lights in its view
    addCamera(document, {.name = "thirty", .y_fov_rad = 0.61f}, {-0.23f, 6.71f, 18.66f},
              {0.84f, 1.65f, 15.86f});
    addCamera(document, {.name = "stall", .y_fov_rad = 0.75f}, {-1.9f, 1.62f, -22.0f},
              {-5.2f, 1.25f, -21.05f});
}

} // namespace

Document makeMarket(uint32_t light_count)
{
    HEARTH_ASSERT(light_count > 0 && light_count <= kMaxMarketLights);
    Document document;
    const market::Plan plan = market::makePlan();
    market::addStreet(document);
    market::addStalls(document, plan);
    market::addGoods(document, plan);
    market::addHouses(document, plan);
    market::addTown(document);
    market::addTrees(document, plan);
    market::addPoles(document, plan);

    std::vector<market::Fixture> fixtures = market::placeFixtures(plan);
    const market::LampModels models = market::addLamps(document, plan, fixtures);
    Animation evening;
    evening.name = "evening";
    const std::vector<market::Fixture> moving = market::addMovingLamps(document, plan, models, evening);
    fixtures.insert(fixtures.end(), moving.begin(), moving.end());
    addMarketPeople(document, plan, evening);
    const std::vector<int> light_of_fixture = market::addLights(document, fixtures, light_count);
    market::addSignTracks(document, fixtures, light_of_fixture, evening);
    document.animations.push_back(std::move(evening));

    addCameras(document);
    addSky(document, "night_sky", market::kSkyRadius, market::nightSkyColor);
    market::addNightShell(document);
    return document;
}

} // namespace hearth::samples
