#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "geometry/core/error.h"

namespace deformlab {

/// Makes objects by name. The constructor takes the built-in ones, and users of the library add
/// their own. A registry may be used from several threads.
template <class Product, class... Arguments>
class Registry {
 public:
  using Factory = std::function<std::unique_ptr<Product>(Arguments...)>;

  ///   kind  what is made, for messages, such as "linear solver"
  Registry(std::string kind, std::vector<std::pair<std::string, Factory>> built_in)
      : kind_(std::move(kind)), factories_(std::move(built_in)) {}

  /// Throws InputError if the name is empty or taken, or if the factory is empty.
  void add(const std::string& name, Factory factory) {
    if (name.empty()) throw InputError(fmt::format("a {} needs a name to be registered", kind_));
    const std::lock_guard lock(mutex_);
    if (place_of(name) != factories_.end()) {
      throw InputError(fmt::format(
          "there is a {} '{}' already; choose another name or register it once only", kind_, name));
    }
    if (!factory) {
      throw InputError(
          fmt::format("the {} '{}' is registered without a factory; give a function that makes it",
                      kind_, name));
    }
    factories_.emplace_back(name, std::move(factory));
  }

  bool has(const std::string& name) const { return static_cast<bool>(find(name)); }

  /// Throws InputError for an unknown name; the message lists the known ones.
  std::unique_ptr<Product> make(const std::string& name, Arguments... arguments) const {
    if (const Factory factory = find(name)) return factory(arguments...);
    throw InputError(
        fmt::format("unknown {} '{}'; known: {}", kind_, name, fmt::join(names(), ", ")));
  }

  std::vector<std::string> names() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> result;
    for (const auto& [name, factory] : factories_) result.push_back(name);
    return result;
  }

 private:
  using Entries = std::vector<std::pair<std::string, Factory>>;

  // The caller holds the lock.
  typename Entries::const_iterator place_of(const std::string& name) const {
    return std::ranges::find(factories_, name, &Entries::value_type::first);
  }

  Factory find(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    const auto place = place_of(name);
    return place == factories_.end() ? nullptr : place->second;
  }

  std::string kind_;
  mutable std::mutex mutex_;
  Entries factories_;
};

}  // namespace deformlab
