#pragma once

#include "Components/ActorComponent.h"

class AActor : public UObject
{
	STUB_CLASS(AActor, UObject)

	template <typename T> T* FindComponentByClass() const
	{
		for (UActorComponent* Component : StubComponents)
		{
			if (T* Found = Cast<T>(Component)) return Found;
		}
		return nullptr;
	}
	template <typename T> void GetComponents(TArray<T*>& Found) const
	{
		for (UActorComponent* Component : StubComponents)
		{
			if (T* Match = Cast<T>(Component)) Found.Add(Match);
		}
	}
	void StubAdd(UActorComponent* Component)
	{
		StubComponents.Add(Component);
		Component->StubOwner = this;
	}
	virtual void BeginPlay() {}

	TArray<UActorComponent*> StubComponents;
};
