// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/texels_gles/gles_decoder.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <bit>
#include <stdexcept>

#include <GLES2/gl2ext.h> // needs the types of gl3.h

namespace hearth::test
{

namespace
{

using formats::TexelFormat;

void require(bool condition, const char* step)
{
    if (!condition)
        throw std::runtime_error(std::string("OpenGL ES: ") + step);
}

GLenum glFormat(TexelFormat format)
{
    switch (format)
    {
    case TexelFormat::etc2_rgb8_unorm:
        return GL_COMPRESSED_RGB8_ETC2;
    case TexelFormat::etc2_rgb8_srgb:
        return GL_COMPRESSED_SRGB8_ETC2;
    case TexelFormat::etc2_rgba8_unorm:
        return GL_COMPRESSED_RGBA8_ETC2_EAC;
    case TexelFormat::etc2_rgba8_srgb:
        return GL_COMPRESSED_SRGB8_ALPHA8_ETC2_EAC;
    case TexelFormat::etc2_rgb8a1_unorm:
        return GL_COMPRESSED_RGB8_PUNCHTHROUGH_ALPHA1_ETC2;
    case TexelFormat::etc2_rgb8a1_srgb:
        return GL_COMPRESSED_SRGB8_PUNCHTHROUGH_ALPHA1_ETC2;
    case TexelFormat::eac_r11_unorm:
        return GL_COMPRESSED_R11_EAC;
    case TexelFormat::eac_r11_snorm:
        return GL_COMPRESSED_SIGNED_R11_EAC;
    case TexelFormat::eac_rg11_unorm:
        return GL_COMPRESSED_RG11_EAC;
    case TexelFormat::eac_rg11_snorm:
        return GL_COMPRESSED_SIGNED_RG11_EAC;
    default:
        throw std::runtime_error("no format of ETC2 or EAC");
    }
}

GLuint compile(GLenum stage, const char* source)
{
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    require(compiled == GL_TRUE, "shader");
    return shader;
}

/// Link a program that writes the bits of each texel's floats: targets of floats would need an extension. It
/// samples, since texelFetch always linearises sRGB.
GLuint makeProgram()
{
    const GLuint program = glCreateProgram();
    glAttachShader(program, compile(GL_VERTEX_SHADER, R"(#version 300 es
void main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, 0, 1); }
)"));
    glAttachShader(program, compile(GL_FRAGMENT_SHADER, R"(#version 300 es
precision highp float;
precision highp int;
uniform highp sampler2D image;
out uvec4 bits;
void main() { bits = floatBitsToUint(texture(image, gl_FragCoord.xy / vec2(textureSize(image, 0)))); }
)"));
    glLinkProgram(program);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    require(linked == GL_TRUE, "program");
    return program;
}

} // namespace

struct GlesDecoder::Context
{
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    GLuint program = 0;

    ~Context()
    {
        if (display == EGL_NO_DISPLAY)
            return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT)
            eglDestroyContext(display, context);
        eglTerminate(display);
    }
};

GlesDecoder::GlesDecoder() : context_(std::make_unique<Context>())
{
    context_->display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    require(context_->display != EGL_NO_DISPLAY, "display without a surface");
    require(eglInitialize(context_->display, nullptr, nullptr) == EGL_TRUE, "display");
    require(eglBindAPI(EGL_OPENGL_ES_API) == EGL_TRUE, "API");
    constexpr std::array<EGLint, 3> kVersion{EGL_CONTEXT_CLIENT_VERSION, 3, EGL_NONE};
    context_->context =
        eglCreateContext(context_->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kVersion.data());
    require(context_->context != EGL_NO_CONTEXT, "context of version 3");
    require(eglMakeCurrent(context_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_->context) == EGL_TRUE,
            "context without a surface");
    const auto* const extensions = reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS));
    require(std::string_view(extensions).find("GL_EXT_texture_sRGB_decode") != std::string_view::npos,
            "sRGB codes");
    context_->program = makeProgram();
    glUseProgram(context_->program);
}

GlesDecoder::~GlesDecoder() = default;

std::string GlesDecoder::name() const
{
    return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

std::vector<std::array<float, 4>> GlesDecoder::decode(const formats::TexelFormatTraits& traits,
                                                      uint32_t width, uint32_t height,
                                                      std::span<const std::byte> blocks) const
{
    const auto w = static_cast<GLsizei>(width), h = static_cast<GLsizei>(height);
    std::array<GLuint, 2> textures{}; // source and target
    glGenTextures(2, textures.data());
    glBindTexture(GL_TEXTURE_2D, textures[1]);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32UI, w, h);
    GLuint framebuffer = 0;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, textures[1], 0);
    require(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE, "target");

    glBindTexture(GL_TEXTURE_2D, textures[0]);
    glCompressedTexImage2D(GL_TEXTURE_2D, 0, glFormat(traits.format), w, h, 0,
                           static_cast<GLsizei>(blocks.size()), blocks.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    if (traits.coding == formats::TexelCoding::srgb)
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SRGB_DECODE_EXT, GL_SKIP_DECODE_EXT);
    glViewport(0, 0, w, h);
    glDrawArrays(GL_TRIANGLES, 0, 3);

    std::vector<std::array<uint32_t, 4>> bits(size_t{width} * height);
    glReadPixels(0, 0, w, h, GL_RGBA_INTEGER, GL_UNSIGNED_INT, bits.data());
    require(glGetError() == GL_NO_ERROR, "drawing");
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(2, textures.data());

    std::vector<std::array<float, 4>> texels(bits.size());
    for (size_t t = 0; t < bits.size(); ++t)
        texels[t] = std::bit_cast<std::array<float, 4>>(bits[t]);
    return texels;
}

} // namespace hearth::test
