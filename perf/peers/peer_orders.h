// What a peer written in C++ does with the orders it reads: one JSON object a line, one answer a line.
#pragma once

#include <exception>
#include <iostream>
#include <string>

#include <nlohmann/json.hpp>

namespace halfframe::peers {

/// `Peer` has load(order), draw(frames) and picture(file), which return the answer or throw.
template <typename Peer>
nlohmann::json answer(Peer& peer, const nlohmann::json& order) {
    try {
        const std::string what = order["do"];
        if (what == "load") return peer.load(order);
        if (what == "draw") return peer.draw(order["frames"]);
        if (what == "picture") return peer.picture(order["file"]);
        return {{"error", "there is no order called " + what}};
    } catch (const std::exception& error) {
        return {{"error", error.what()}};
    }
}

/// Until there are no more orders. `answered(order)` is answer() with whatever has to surround it.
template <typename Answered>
void obey_orders(Answered&& answered) {
    for (std::string line; std::getline(std::cin, line);)
        std::cout << answered(nlohmann::json::parse(line)).dump() << std::endl;
}

}  // namespace halfframe::peers
