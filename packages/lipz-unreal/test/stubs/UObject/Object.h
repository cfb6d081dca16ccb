#pragma once

#include "CoreMinimal.h"

struct UClass
{
	const char* Name;
	const UClass* Super;
};

enum EObjectFlags { RF_NoFlags = 0, RF_Public = 1, RF_Standalone = 2 };
constexpr EObjectFlags operator|(EObjectFlags A, EObjectFlags B) { return static_cast<EObjectFlags>(int(A) | int(B)); }

class UObject
{
public:
	UObject();
	virtual ~UObject() = default;
	UObject(const UObject&) = delete;
	UObject& operator=(const UObject&) = delete;
	static UClass* StaticClass();
	FString GetName() const { return StubName; }
	FString GetPathName() const { return StubName; }
	void MarkPackageDirty() { bStubIsDirty = true; }
	void ClearFlags(EObjectFlags Flags) { StubFlags = static_cast<EObjectFlags>(StubFlags & ~Flags); }

	const UClass* StubClass = StaticClass();
	FString StubName = TEXT("Stub");
	EObjectFlags StubFlags = RF_NoFlags;
	bool bStubIsDirty = false;
};

/** Deletes all objects. */
void StubCollectGarbage();

template <typename T> T* NewObject(UObject* = nullptr, const UClass* Class = T::StaticClass(), FName Name = FName(), EObjectFlags Flags = RF_NoFlags)
{
	T* Object = new T();
	Object->StubClass = Class;
	Object->StubFlags = Flags;
	if (!Name.IsNone()) Object->StubName = Name.ToString();
	return Object;
}

template <typename T, typename F> auto Cast(F* Object)
{
	using Target = std::conditional_t<std::is_const_v<F>, const T, T>;
	for (const UClass* Class = Object == nullptr ? nullptr : Object->StubClass; Class != nullptr; Class = Class->Super)
	{
		if (Class == T::StaticClass()) return static_cast<Target*>(Object);
	}
	return static_cast<Target*>(nullptr);
}

inline bool IsValid(const UObject* Object) { return Object != nullptr; }

/** What the header tool adds to a class. */
#define STUB_CLASS(Class, Parent) \
public: \
	using Super = Parent; \
	static UClass* StaticClass() \
	{ \
		static UClass Found = {#Class, Parent::StaticClass()}; \
		return &Found; \
	}
