#include "assets/json_place.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace relievo {

namespace {

using nlohmann::json;

// Walks text and document side by side. The text is known to be JSON, as it was parsed before; nesting may be as deep as the file is
// long, so that what is open stands in a vector and not on the stack.
class Walk {
public:
    Walk(std::string_view text, const json& wanted) : text_(text), wanted_(&wanted) {}

    std::size_t run(const json& document) {
        skip_blanks();
        std::size_t found = at_;
        const json* known = &document;  // the value that begins here; null inside one that a later one of the same name replaced
        do {
            skip_blanks();
            if (known == wanted_) found = at_;
            if (here() == '{' || here() == '[') {
                open_.push_back({known, here() == '{', 0});
                ++at_;
            } else if (here() == '"') {
                skip_string();
            } else {
                at_ = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
            }
        } while (to_next_value(known));
        return found;
    }

private:
    struct Open {
        const json* known;
        bool object;
        std::size_t values;  // that were met in it
    };

    char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    void skip_blanks() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }

    void skip_string() {
        for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_)
            if (text_[at_] == '\\') ++at_;
        at_ = std::min(at_ + 1, text_.size());
    }

    bool to_next_value(const json*& known) {
        for (; !open_.empty() && at_ < text_.size(); ++at_) {
            skip_blanks();
            if (here() == '}' || here() == ']') {
                open_.pop_back();
                continue;
            }
            Open& in = open_.back();
            if (here() == ',') {
                ++at_;
                skip_blanks();
            }
            const std::size_t i = in.values++;
            known = nullptr;
            if (in.object) {
                const std::size_t begin = at_;
                skip_string();
                const std::string key = json::parse(text_.substr(begin, at_ - begin)).get<std::string>();
                skip_blanks();
                ++at_;  // the colon
                if (in.known && in.known->is_object())
                    if (const auto member = in.known->find(key); member != in.known->end()) known = &*member;
            } else if (in.known && in.known->is_array() && i < in.known->size()) {
                known = &(*in.known)[i];
            }
            return true;
        }
        return false;
    }

    std::string_view text_;
    const json* wanted_;
    std::size_t at_ = 0;
    std::vector<Open> open_;
};

}  // namespace

std::size_t byte_of(std::string_view text, const json& document, const json& value) { return Walk(text, value).run(document); }

}  // namespace relievo
