// The list of built-in scenes, and the empty one.
#include "content/built_in.h"

#include "content/charts/charts.h"
#include "content/content.h"
#include "content/memory_room/memory_room.h"
#include "content/street/street.h"

namespace halfframe::content {

Scene make_empty() {
    Scene scene;
    scene.name = "empty";
    Camera camera = camera_looking({0.0f, 0.0f, 3.0f}, glm::vec3(0.0f), 0.8f, Box{glm::vec3(-1.0f), glm::vec3(1.0f)});
    camera.name = "front";
    scene.cameras.push_back(camera);
    return scene;
}

const std::vector<BuiltInScene>& built_in_scenes() {
    static const std::vector<BuiltInScene> kScenes{
        {"furnace", "three spheres in constant light: reads off the energy that comes back", &make_furnace},
        {"test_room", "a small room with one of everything: textures, mask, glass, metal, and all kinds of lights",
         &make_test_room},
        {"spheres", "metals and dielectrics from rough to smooth, lit by the studio environment alone", &make_spheres},
        {"charts", "the artists' charts: published albedos, metals, and smoothness from rough to smooth, with names",
         &make_charts},
        {"lamps", "panels from smooth to rough under shining spheres and points: what the radius of a light does",
         &make_lamps},
        {"wet_yard", "a yard after rain: hollows, joints, a canopy, and what soaks beside what does not",
         &make_wet_yard},
        {"street", "Neo-Paris at night, made from a seed: facades, neon, an arcade, people; six cameras",
         [] { return make_street(street::kDefaultSeed); }, &make_street},
        {"memory_room", "a white space of glass shards, frames and light: translucents at many depths, from a seed",
         [] { return make_memory_room(memory_room::kDefaultSeed); }, &make_memory_room},
        {"empty", "nothing at all: what a frame costs before anything is drawn", &make_empty},
    };
    return kScenes;
}

}  // namespace halfframe::content
