#pragma once

/// One of a class in the process, made when it is first asked for and left where it is.
template <class T>
class SingletonT
{
public:
  static T* Instance()
  {
    static T* one = new T;
    return one;
  }

protected:
  SingletonT() = default;
  virtual ~SingletonT() = default;
};
