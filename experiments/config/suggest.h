#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace deformlab {

/// The least number of insertions, deletions, substitutions and swaps of neighbours that turn
/// `given` into `known`, where upper and lower case are equal (optimal string alignment distance).
int edit_distance(std::string_view given, std::string_view known);

/// The known name that is nearest to `given`, or nothing if none is near. Among equally near names,
/// it is the first one.
std::optional<std::string> nearest_name(std::string_view given,
                                        const std::vector<std::string>& known);

/// What a message says after a name that is not known: "known: a, b, c; did you mean 'b'?". It asks
/// the question only if a known name is near. A name of an earlier version gives "it is called 'b'
/// now" instead. `prefix` is the dotted path before a key, with a dot at its end.
std::string known_names(std::string_view given, const std::vector<std::string>& known,
                        std::string_view prefix = "");

/// The text in quotes for a message. Long text is cut, and control characters become '?', so that
/// the message is always one readable line.
std::string quote(std::string_view text);

}  // namespace deformlab
