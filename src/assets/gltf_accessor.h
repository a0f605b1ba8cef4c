// glTF's binary data: buffers, views of them, and accessors that say how a view's bytes are numbers (glTF 2.0, chapters 3.6 and 5.1).
#pragma once

#include "assets/mesh_formats.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace relievo {

class GltfData {
public:
    // `text` is what the document was parsed from and lies in `bytes`, the file. `binary` is the second chunk of a GLB, empty for JSON.
    // Buffers are read when they are first needed.
    GltfData(const nlohmann::json& document, std::string_view text, std::string_view bytes, std::string_view binary, const ReadUri& read_uri, const std::string& file);
    ~GltfData();

    // Elements of `components` floats each, one after the other; integers that the accessor calls normalised become shares.
    // Throws Error where the accessor has another shape or reaches beyond its data.
    std::vector<float> floats(std::int64_t accessor, std::size_t& components);
    std::vector<std::uint32_t> indices(std::int64_t accessor);

    // Elements of an accessor, checked against the data it has, without reading it.
    std::size_t count(std::int64_t accessor);

    // A number of the document, which JSON does not confine to whole ones.
    std::int64_t integer(const nlohmann::json& value) const;

    // What is read now: the library says what it misses there, and not where that is.
    void read_at(const nlohmann::json& value) { reading_ = &value; }
    const nlohmann::json& reading() const { return *reading_; }

    // Throws Error naming the byte at which `value`, a part of the document, stands in the file.
    [[noreturn]] void fail(const nlohmann::json& value, const std::string& why) const;

private:
    struct View;
    struct Accessor;
    std::uint64_t number(const nlohmann::json& object, const char* key, std::uint64_t otherwise) const;
    std::string_view buffer(std::int64_t index);
    View view(std::int64_t index);
    Accessor accessor(std::int64_t index);
    template <class T, class Convert>
    std::vector<T> values(const Accessor& from, const Convert& convert);

    const nlohmann::json& document_;
    std::string_view text_, bytes_, binary_;
    const nlohmann::json* reading_;
    const ReadUri& read_uri_;
    const std::string& file_;
    std::vector<std::string> buffers_;
    std::vector<bool> read_;
};

}  // namespace relievo
