#include "LipzMorphTargets.h"

#include "Animation/MorphTarget.h"
#include "Components/SkeletalMeshComponent.h"
#include "Engine/SkeletalMesh.h"
#include "LipzShapeNames.h"

TArray<FName> FLipzMorphTargets::Find(USkeletalMeshComponent* Mesh, const TArray<FName>& Weights, const TMap<FName, FName>& Renamed)
{
	TArray<FString> Names;
	if (Mesh != nullptr && Mesh->GetSkeletalMeshAsset() != nullptr)
	{
		for (const UMorphTarget* Target : Mesh->GetSkeletalMeshAsset()->GetMorphTargets())
		{
			Names.Add(Target != nullptr ? Target->GetName() : FString());
		}
	}
	Targets.Reset();
	TArray<FName> Missing;
	for (int32 Weight = 0; Weight < Weights.Num(); Weight++)
	{
		const FName* Other = Renamed.Find(Weights[Weight]);
		const int32 Found = LipzShapeNames::Find((Other != nullptr ? *Other : Weights[Weight]).ToString(), Names);
		if (Found == INDEX_NONE)
		{
			Missing.Add(Weights[Weight]);
		}
		else
		{
			Targets.Add(TPair<int32, FName>(Weight, FName(*Names[Found])));
		}
	}
	return Missing;
}

void FLipzMorphTargets::Show(USkeletalMeshComponent* Mesh, const TArray<float>& Values) const
{
	for (const TPair<int32, FName>& Target : Targets)
	{
		Mesh->SetMorphTarget(Target.Value, Values[Target.Key]);
	}
}
