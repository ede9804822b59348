// try_context BACKEND API: makes a context and says what came: the back end, the description, then a line for each back
// end that was tried first. Without a context: the sentence, and exit code 4.
#include <cstdio>
#include <string_view>

#include "platform/context.h"

int main(int argc, char** argv) {
    using namespace halfframe::platform;
    if (argc != 3) return 2;
    ContextDescription description;
    for (const Backend backend : {Backend::egl, Backend::osmesa, Backend::glfw}) {
        if (std::string_view(argv[1]) == name(backend)) description.backend = backend;
    }
    description.api = std::string_view(argv[2]) == "desktop" ? Api::desktop : Api::es;
    try {
        const Context context = Context::create(description);
        std::printf("%s\n%s\n", name(context.backend()), context.description().c_str());
        for (const auto& sentence : context.tried()) std::printf("tried: %s\n", sentence.c_str());
        return 0;
    } catch (const ContextError& error) {
        std::printf("%s\n", error.what());
        return 4;
    }
}
