/** How the parts of the autopilot know each other. */
#pragma once

namespace raspilot {

/**
 * Refers to the object that a constructor was given. On the chip there is one object of each type:
 * the compiler knows its address there, and nothing is stored or loaded (chip/machine.cpp).
 */
template <typename T>
class Reference {
 public:
#ifdef __AVR__
  explicit Reference(T&) {}
  T* operator->() const { return &only; }
  T& operator*() const { return only; }

 private:
  static T& only;
  /** Makes it take no memory. */
  char nothing_[0];
#else
  explicit Reference(T& object) : object_(object) {}
  T* operator->() const { return &object_; }
  T& operator*() const { return object_; }

 private:
  T& object_;
#endif
};

}  // namespace raspilot
