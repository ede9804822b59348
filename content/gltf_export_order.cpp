// A loader meets things in the order of the node tree. Three lists have to come out in their own order, so roots are
// sorted by "stands before" (Kahn 1962); a file that was loaded has such an order, because it came out of a tree.
#include "content/gltf_export_order.h"

#include <map>
#include <set>

namespace halfframe::content {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

class RootSorter {
public:
    /// Places in the order in which they are first met.
    std::size_t place_of(const ExportRoot& root) {
        const auto [known, is_new] = places_.try_emplace(root, roots_.size());
        if (is_new) {
            roots_.push_back(root);
            after_.emplace_back();
            before_.push_back(0);
        }
        return known->second;
    }

    void add_in_order(std::size_t before, std::size_t after) {
        if (before != after && after_[before].insert(after).second) ++before_[after];
    }

    /// Earliest met first, of those that nothing stands before; of all where they stand in a circle.
    std::vector<ExportRoot> sorted() {
        std::vector<ExportRoot> result;
        std::set<std::size_t> waiting, ready;
        for (std::size_t i = 0; i < roots_.size(); ++i) (before_[i] == 0 ? ready : waiting).insert(i);
        while (!ready.empty() || !waiting.empty()) {
            std::set<std::size_t>& from = ready.empty() ? waiting : ready;
            const std::size_t next = *from.begin();
            from.erase(from.begin());
            result.push_back(roots_[next]);
            for (const std::size_t other : after_[next]) {
                if (--before_[other] == 0 && waiting.erase(other) > 0) ready.insert(other);
            }
        }
        return result;
    }

private:
    std::map<ExportRoot, std::size_t> places_;
    std::vector<ExportRoot> roots_;
    std::vector<std::set<std::size_t>> after_;
    std::vector<std::size_t> before_;
};

int topmost_moving(const Scene& scene, const std::vector<bool>& moves, int node) {
    if (!moves[at(node)]) return node;
    int parent = scene.nodes[at(node)].parent;
    while (parent >= 0 && moves[at(parent)]) {
        node = parent;
        parent = scene.nodes[at(node)].parent;
    }
    return node;
}

}  // namespace

std::vector<bool> nodes_that_move(const Scene& scene) {
    std::vector<bool> moves(scene.nodes.size());
    for (const Animation& animation : scene.animations) {
        for (const AnimationChannel& channel : animation.channels) moves[at(channel.node)] = true;
    }
    for (const Skin& skin : scene.skins) {
        for (const int joint : skin.joints) moves[at(joint)] = true;
    }
    for (std::size_t i = 0; i < moves.size(); ++i) {  // parents stand before their children
        const int parent = scene.nodes[i].parent;
        if (parent >= 0 && moves[at(parent)]) moves[i] = true;
    }
    return moves;
}

int carrying_node(const Scene& scene, const std::vector<bool>& moves, const Surface& surface) {
    if (surface.node < 0) return -1;
    const bool morphs = !scene.meshes[at(surface.mesh)].morph_targets.empty();
    const bool carried = moves[at(surface.node)] && surface.skin < 0;
    return morphs || carried ? surface.node : -1;
}

std::vector<ExportRoot> export_order(const Scene& scene, const std::vector<bool>& moves) {
    RootSorter sorter;
    const auto root_of = [&](int node) { return ExportRoot{.node = topmost_moving(scene, moves, node)}; };
    const auto add_list = [&](std::size_t count, auto&& root_at) {
        std::size_t last = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t place = sorter.place_of(root_at(i));
            if (i > 0) sorter.add_in_order(last, place);
            last = place;
        }
    };
    add_list(scene.surfaces.size(), [&](std::size_t i) {
        const int node = carrying_node(scene, moves, scene.surfaces[i]);
        return node < 0 ? ExportRoot{.surface = static_cast<int>(i)} : root_of(node);
    });
    add_list(scene.cameras.size(), [&](std::size_t i) {
        const int node = scene.cameras[i].node;
        return node < 0 || !moves[at(node)] ? ExportRoot{.camera = static_cast<int>(i)} : root_of(node);
    });
    add_list(scene.lights.size(), [&](std::size_t i) {
        const int node = scene.lights[i].node;
        return node < 0 || !moves[at(node)] ? ExportRoot{.light = static_cast<int>(i)} : root_of(node);
    });
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {  // bones that carry nothing but a skin
        if (moves[i]) (void)sorter.place_of(root_of(static_cast<int>(i)));
    }
    return sorter.sorted();
}

}  // namespace halfframe::content
