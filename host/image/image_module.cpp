// SPDX-License-Identifier: MIT
// All of clrt's C++: two C functions that call OpenImageIO and catch every exception.
#include "image/image_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

namespace
{

void describe_layers(OIIO::ImageSpec &spec, const ImageModulePicture &picture)
{
    spec.nchannels += static_cast<int>(picture.layer_count);
    spec.channelformats.assign(3, OIIO::TypeDesc::FLOAT);
    for (size_t i = 0; i < picture.layer_count; i++) {
        spec.channelnames.push_back(picture.layer_names[i]);
        spec.channelformats.push_back(picture.layer_is_integer[i] ? OIIO::TypeDesc::UINT32
                                                                  : OIIO::TypeDesc::FLOAT);
    }
}

// A rectangle of the picture, and its place in the arrays of colors and layers.
struct Region {
    int x, y, width, height;
    size_t first, pitch; // in pixels
};

// Interleaves the arrays of colors and layers, one region at a time, to avoid a second copy of the
// picture.
bool write_region(OIIO::ImageOutput &output, const ImageModulePicture &picture,
                  const Region &region, std::vector<char> &values)
{
    constexpr size_t color_size = 3 * sizeof(float);
    const size_t layer_size = picture.layer_count * sizeof(uint32_t);
    const auto width = static_cast<size_t>(region.width),
               height = static_cast<size_t>(region.height);
    values.resize(width * height * (color_size + layer_size));
    char *next = values.data();
    for (size_t row = 0; row < height; row++)
        for (size_t column = 0; column < width; column++) {
            const size_t pixel = region.first + row * region.pitch + column;
            std::memcpy(next, static_cast<const char *>(picture.pixels) + pixel * color_size,
                        color_size);
            if (layer_size > 0)
                std::memcpy(next + color_size,
                            static_cast<const char *>(picture.layers) + pixel * layer_size,
                            layer_size);
            next += color_size + layer_size;
        }
    const int x = output.spec().x + region.x, y = output.spec().y + region.y;
    return output.write_tiles(x, x + region.width, y, y + region.height, 0, 1,
                              OIIO::TypeDesc::UNKNOWN, values.data());
}

// Writes the tiles of a part, or one row of tiles after the other.
bool write_regions(OIIO::ImageOutput &output, const ImageModulePicture &picture)
{
    std::vector<char> values;
    const int width = std::min(picture.tile_width, picture.width);
    const int height = std::min(picture.tile_height, picture.height);
    const auto pitch = static_cast<size_t>(picture.is_part ? width : picture.width);
    bool ok = true;
    for (size_t i = 0; ok && i < picture.tile_count; i++) {
        const int x = int(picture.tiles[2 * i]), y = int(picture.tiles[2 * i + 1]);
        ok = write_region(output, picture,
                          {x, y, std::min(width, picture.width - x),
                           std::min(height, picture.height - y), i * size_t(height) * pitch, pitch},
                          values);
    }
    for (int y = 0; ok && !picture.is_part && y < picture.height; y += height)
        ok = write_region(
            output, picture,
            {0, y, picture.width, std::min(height, picture.height - y), size_t(y) * pitch, pitch},
            values);
    return ok;
}

// Stores a crop's position in EXR, the only format from which other programs read it.
void describe_place(OIIO::ImageSpec &spec, const ImageModulePicture &picture)
{
    if (picture.whole_width == 0 || std::strcmp(picture.format, "openexr") != 0)
        return;
    spec.x = picture.left;
    spec.y = picture.top;
    spec.full_width = picture.whole_width;
    spec.full_height = picture.whole_height;
}

// TIFF and JPEG have no fields with custom names, so their description has one line per text.
void describe_origin(OIIO::ImageSpec &spec, const ImageModulePicture &picture)
{
    std::string lines;
    const std::string format = picture.format;
    for (size_t i = 0; i < picture.text_count; i++) {
        const std::string name = picture.texts[2 * i], value = picture.texts[2 * i + 1];
        // clrt merge copies the tiles of EXR files without decoding them, so it knows no pixels.
        if (name == "clrt:pixel_hash" && format == "openexr")
            continue;
        spec.attribute(name, value);
        if (name.rfind("clrt:", 0) == 0)
            lines += name + "=" + value + "\n";
    }
    if (!lines.empty() && (format == "tiff" || format == "jpeg"))
        spec.attribute("ImageDescription", lines);
}

// Writes an animation of 20 frames per second, as subimages.
bool write_frames(OIIO::ImageOutput &output, const OIIO::ImageSpec &whole,
                  const ImageModulePicture &picture)
{
    OIIO::ImageSpec spec = whole;
    spec.height = spec.full_height = picture.height / picture.frames;
    spec.attribute("FramesPerSecond", 20.0f);
    const char *pixels = static_cast<const char *>(picture.pixels);
    const std::vector<OIIO::ImageSpec> specs(static_cast<size_t>(picture.frames), spec);
    bool ok = output.open(picture.path, picture.frames, specs.data());
    for (int frame = 0; ok && frame < picture.frames; frame++)
        ok = (frame == 0 || output.open(picture.path, spec, OIIO::ImageOutput::AppendSubimage)) &&
             output.write_image(spec.format,
                                pixels + spec.image_bytes() * static_cast<size_t>(frame));
    return ok;
}

// Closes the writer while its target still exists, even after a failure.
bool write_all(OIIO::ImageOutput &output, const OIIO::ImageSpec &spec,
               const ImageModulePicture &picture)
{
    const bool written = picture.frames > 0                 ? write_frames(output, spec, picture)
                         : !output.open(picture.path, spec) ? false
                         : picture.layer_count > 0 || picture.is_part
                             ? write_regions(output, picture)
                             : output.write_image(spec.format, picture.pixels);
    return output.close() && written;
}

// Writes to memory first if the format supports it. On a full disk, some writers report no error,
// and libjpeg ends the process.
bool write_through_memory(OIIO::ImageOutput &output, const OIIO::ImageSpec &spec,
                          const ImageModulePicture &picture)
{
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const bool in_memory = output.supports("ioproxy") && output.set_ioproxy(&memory);
    const bool ok = write_all(output, spec, picture);
    if (!ok || !in_memory)
        return ok;
    FILE *file = std::fopen(picture.path, "wb");
    if (file == nullptr)
        return false;
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    return std::fclose(file) == 0 && written;
}

// A file that never reports a failed write, because OpenEXR then waits for its threads forever.
class PatientFile : public OIIO::Filesystem::IOFile
{
  public:
    explicit PatientFile(FILE *file) : IOFile(file, Write)
    {
    }
    size_t write(const void *bytes, size_t size) override
    {
        IOFile::write(bytes, size);
        return size;
    }
};

// Writes directly, because EXR files may be as large as the picture. Checks the stream here,
// because PatientFile reports no errors.
bool write_to_file(OIIO::ImageOutput &output, const OIIO::ImageSpec &spec,
                   const ImageModulePicture &picture)
{
    FILE *file = std::fopen(picture.path, "wb");
    if (file == nullptr)
        return false;
    PatientFile direct(file);
    const bool ok = output.set_ioproxy(&direct) && write_all(output, spec, picture);
    const bool written = std::ferror(file) == 0;
    return std::fclose(file) == 0 && written && ok;
}

bool write_picture(const ImageModulePicture &picture, std::string &message)
{
    auto output = OIIO::ImageOutput::create(picture.format);
    if (!output) {
        message = OIIO::geterror();
        return false;
    }
    const auto type = picture.is_float ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
    OIIO::ImageSpec spec(picture.width, picture.height, 3, type);
    if (picture.layer_count > 0)
        describe_layers(spec, picture);
    describe_place(spec, picture);
    // Without this attribute, OpenEXR and TIFF store the current time, and equal pictures make
    // different files.
    spec.attribute("DateTime", "");
    spec.attribute("CompressionQuality", 95);
    describe_origin(spec, picture);
    const bool is_exr = std::strcmp(picture.format, "openexr") == 0;
    if (is_exr) {
        spec.tile_width = picture.tile_width;
        spec.tile_height = picture.tile_height;
    }
    // In other orders, OpenEXR waits for missing tiles before it writes the following ones.
    if (picture.tile_count > 0)
        spec.attribute("openexr:lineOrder", "randomY");
    errno = 0;
    const bool ok = is_exr ? write_to_file(*output, spec, picture)
                           : write_through_memory(*output, spec, picture);
    if (!ok)
        message = errno != 0 ? std::strerror(errno) : output->geterror();
    return ok;
}

bool check_head(const OIIO::ImageSpec &spec, uint64_t values_max, std::string &message)
{
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1)
        message = "it holds no flat picture";
    else if (spec.deep)
        message = "deep pictures are not read";
    else if (spec.nchannels > IMAGE_MODULE_CHANNELS ||
             uint64_t(spec.width) * uint64_t(spec.height) > values_max / uint64_t(spec.nchannels))
        message = "it is too large";
    return message.empty();
}

void fill_head(const OIIO::ImageSpec &spec, ImageModuleContent &content)
{
    content.width = uint32_t(spec.width);
    content.height = uint32_t(spec.height);
    content.channel_count = uint32_t(spec.nchannels);
    content.is_8_bit = spec.format == OIIO::TypeDesc::UINT8 && spec.channelformats.empty();
    for (int i = 0; i < spec.nchannels; i++)
        std::snprintf(content.names[i], sizeof content.names[i], "%s",
                      spec.channel_name(i).c_str());
    for (int i = 0; i < IMAGE_MODULE_TEXTS; i++)
        std::snprintf(content.texts[i], sizeof content.texts[i], "%s",
                      std::string(spec.get_string_attribute(content.text_names[i])).c_str());
}

bool is_color(const std::string &name)
{
    return name == "R" || name == "G" || name == "B" || name == "Y" || name == "A";
}

bool names_things(const OIIO::ImageSpec &spec, int channel)
{
    return spec.channelformat(channel) == OIIO::TypeDesc::UINT32 &&
           !is_color(spec.channel_name(channel));
}

// Channels of 32-bit integers hold ids, which are stored unchanged in place of floats. Other
// channels are converted to type. Each call reads adjacent channels of one kind.
bool read_channels(OIIO::ImageInput &input, const OIIO::ImageSpec &spec, OIIO::TypeDesc type,
                   void *values)
{
    const auto size = static_cast<OIIO::stride_t>(type.size());
    bool ok = true;
    for (int first = 0, end = 0; ok && first < spec.nchannels; first = end) {
        const bool integer = names_things(spec, first);
        while (end < spec.nchannels && names_things(spec, end) == integer)
            end++;
        ok = input.read_image(0, 0, first, end, integer ? OIIO::TypeDesc::UINT32 : type,
                              static_cast<char *>(values) + first * size, spec.nchannels * size);
    }
    return ok;
}

bool read_picture(const char *path, const char *format, ImageModuleContent &content,
                  std::string &message)
{
    auto input = OIIO::ImageInput::create(format);
    OIIO::ImageSpec spec;
    if (!input || !input->open(path, spec)) {
        message = input ? input->geterror() : OIIO::geterror();
        return false;
    }
    if (!check_head(spec, content.values_max, message))
        return false;
    fill_head(spec, content);
    const OIIO::TypeDesc type = content.is_8_bit ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
    content.values = std::malloc(size_t(spec.width) * size_t(spec.height) * size_t(spec.nchannels) *
                                 type.size());
    if (content.values == nullptr) {
        message = "memory ran out";
        return false;
    }
    const bool ok = read_channels(*input, spec, type, content.values);
    message = input->geterror();
    return ok;
}

// Returns whether work succeeds without an exception. Otherwise, message receives the reason.
template <typename Work> int guarded(char *message, size_t message_size, Work work)
{
    std::string text;
    bool ok = false;
    try {
        ok = work(text);
    } catch (const std::exception &failure) {
        text = failure.what();
    } catch (...) {
        text = "an unknown exception";
    }
    std::snprintf(message, message_size, "%s", text.c_str());
    return ok;
}

} // namespace

int clrt_image_module_read(const char *path, const char *format, ImageModuleContent *content,
                           char *message, size_t message_size)
{
    return guarded(message, message_size,
                   [&](std::string &text) { return read_picture(path, format, *content, text); });
}

int clrt_image_module_write(const ImageModulePicture *picture, char *message, size_t message_size)
{
    return guarded(message, message_size,
                   [&](std::string &text) { return write_picture(*picture, text); });
}
