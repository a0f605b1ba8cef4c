// Damage that picture decoders let pass: they invent the missing part, or complain on standard error before they give up.
#pragma once

#include <filesystem>
#include <string>

namespace relievo {

// What is wrong with the file as a container of the format (OpenImageIO's name for it), or an empty string. Looks at its
// structure, not at its texels: PNG chunks and their checksums, the JPEG end marker, the extent of TIFF strips and of DDS
// data; other decoders need no help.
std::string damage_of(const std::filesystem::path& file, const std::string& format);

}  // namespace relievo
