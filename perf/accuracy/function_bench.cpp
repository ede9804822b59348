// A fragment shader round the function, and one draw.
#include "perf/accuracy/function_bench.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe::accuracy {
namespace {

std::string type_of(int components) { return components == 1 ? "float" : fmt::format("vec{}", components); }

std::string main_of(const DrawnFunction& function) {
    std::string text;
    for (const std::string& file : function.files) text += fmt::format("#include \"{}\"\n", file);
    text += "#include \"<functions>\"\n";
    std::string body = "    ivec2 lane = ivec2(gl_FragCoord.xy);\n";
    std::string arguments;
    for (std::size_t i = 0; i < function.parameters.size(); ++i) {
        const DrawnParameter& parameter = function.parameters[i];
        const bool full = parameter.full || function.arithmetic == gl::Arithmetic::full;
        text += fmt::format("uniform highp sampler2D input_{};\n", i);
        body += fmt::format("    {} {} a{} = texelFetch(input_{}, lane, 0).{};\n", full ? "highp" : "mediump",
                            type_of(parameter.components), i, i,
                            std::string("rgba").substr(0, static_cast<std::size_t>(parameter.components)));
        arguments += fmt::format("{}a{}", i == 0 ? "" : ", ", i);
    }
    const std::string plain = function.function.substr(0, function.function.find('('));
    body += fmt::format("    fragment_color = vec4({}({}){});\n", plain, arguments,
                        function.returned == 1   ? ", 0.0, 0.0, 1.0"
                        : function.returned == 2 ? ", 0.0, 1.0"
                        : function.returned == 3 ? ", 1.0"
                                                 : "");
    return text + "void main() {\n" + body + "}\n";
}

std::size_t lanes_of(const std::vector<shader_ir::Columns>& inputs) {
    std::size_t lanes = 0;
    for (const shader_ir::Columns& columns : inputs) {
        for (const std::vector<double>& column : columns) lanes = std::max(lanes, column.size());
    }
    return lanes;
}

}  // namespace

std::vector<float> draw_function(gl::EntryPoints& gl, const gl::Caps& caps, const DrawnFunction& function,
                                 const std::vector<shader_ir::Columns>& inputs) {
    expect(inputs.size() == function.parameters.size() && inputs.size() <= 16,
           "a drawn function has inputs for its parameters, at most the 16 that ES 3.0 has samplers for");
    LaneCanvas canvas(gl, caps, lanes_of(inputs));
    const std::string main = main_of(function);
    std::vector<gl::ShaderFile> files(function.available.begin(), function.available.end());
    files.push_back({"<functions>", function.more_text});
    files.push_back({"<main>", main});
    gl::ProgramCache programs(gl, caps, {}, files);
    gl::ProgramDescription description;
    description.name = function.function;
    description.vertex = "probe/precision.vert";
    description.fragment = "<main>";
    description.arithmetic = function.arithmetic;
    description.defines = function.defines;
    description.attributes = LaneCanvas::attributes();
    gl::Program& program = programs.get(description);
    gl.UseProgram(program.name());
    std::vector<gl::Texture> textures;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
        textures.push_back(canvas.texture(inputs[i]));
        // A function may ignore a parameter; the compiler then drops its texture.
        if (const int location = program.uniform_if_used(fmt::format("input_{}", i)); location >= 0)
            gl.Uniform1i(location, static_cast<GLint>(i));
    }
    gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(inputs.size()));
    const gl::Texture target = canvas.target(gl::PixelFormat::rgba32f);
    canvas.draw_to(target);
    gl.ActiveTexture(GL_TEXTURE0);
    return canvas.read();
}

}  // namespace halfframe::accuracy
