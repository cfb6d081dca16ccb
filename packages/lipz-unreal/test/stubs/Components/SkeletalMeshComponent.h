#pragma once

#include "Components/ActorComponent.h"

class USkeletalMesh;

class USkeletalMeshComponent : public UActorComponent
{
	STUB_CLASS(USkeletalMeshComponent, UActorComponent)

	USkeletalMesh* GetSkeletalMeshAsset() const { return StubMesh; }
	void SetMorphTarget(FName Name, float Value, bool = true) { StubWeights.Add(Name, Value); }

	USkeletalMesh* StubMesh = nullptr;
	TMap<FName, float> StubWeights;
};
