#error "there is no GpuLaser here: a gpu_ray sensor casts rays; its scans come from GpuRaySensor (ConnectNewLaserFrame, Ranges)"
