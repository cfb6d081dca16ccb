#pragma once

#include <cstddef>
#include <memory>
#include <utility>

template <typename T> class TSharedPtr
{
public:
	TSharedPtr() = default;
	TSharedPtr(std::nullptr_t) {}
	TSharedPtr(std::shared_ptr<T> InPointer) : Pointer(std::move(InPointer)) {}
	bool IsValid() const { return Pointer != nullptr; }
	explicit operator bool() const { return IsValid(); }
	T* Get() const { return Pointer.get(); }
	T* operator->() const { return Pointer.get(); }
	T& operator*() const { return *Pointer; }

private:
	std::shared_ptr<T> Pointer;
};

template <typename T> using TSharedRef = TSharedPtr<T>;
template <typename T, typename... A> TSharedPtr<T> MakeShared(A&&... Arguments)
{
	return TSharedPtr<T>(std::make_shared<T>(std::forward<A>(Arguments)...));
}
template <typename T> TSharedPtr<T> MakeShareable(T* Pointer) { return TSharedPtr<T>(std::shared_ptr<T>(Pointer)); }

template <typename T> class TObjectPtr
{
public:
	TObjectPtr(T* InPointer = nullptr) : Pointer(InPointer) {}
	T* Get() const { return Pointer; }
	operator T*() const { return Pointer; }
	T* operator->() const { return Pointer; }
	T& operator*() const { return *Pointer; }

private:
	T* Pointer;
};
