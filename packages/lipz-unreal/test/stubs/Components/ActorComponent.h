#pragma once

#include "UObject/Object.h"

enum ELevelTick { LEVELTICK_TimeOnly, LEVELTICK_ViewportsOnly, LEVELTICK_All, LEVELTICK_PauseTick };
namespace EEndPlayReason
{
enum Type { Destroyed, LevelTransition, EndPlayInEditor, RemovedFromWorld, Quit };
}

struct FActorComponentTickFunction
{
	bool bCanEverTick = false;
	bool bStartWithTickEnabled = true;
	bool bTickEvenWhenPaused = false;
};

class AActor;

class UActorComponent : public UObject
{
	STUB_CLASS(UActorComponent, UObject)

	AActor* GetOwner() const { return StubOwner; }
	void SetComponentTickEnabled(bool bEnabled) { bStubTicks = bEnabled; }
	void AddTickPrerequisiteComponent(UActorComponent* First) { StubPrerequisite = First; }
	virtual void TickComponent(float, ELevelTick, FActorComponentTickFunction*) {}
	virtual void EndPlay(const EEndPlayReason::Type) {}

	FActorComponentTickFunction PrimaryComponentTick;
	AActor* StubOwner = nullptr;
	UActorComponent* StubPrerequisite = nullptr;
	bool bStubTicks = false;
};
